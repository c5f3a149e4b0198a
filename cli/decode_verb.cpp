// fbs decode: stream to pictures.
#include <optional>

#include "cli/loss_report.h"
#include "cli/progress.h"
#include "cli/stream_file.h"
#include "cli/verbs.h"
#include "cli/video/video_sink.h"

namespace fbs::cli {

Result<Outcome> run_decode(const DecodeArguments& arguments) {
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  if (arguments.from > 0)
    if (auto sought = file->seek(ticks(arguments.from)); !sought) return fail(sought.error());
  StreamDecoder& decoder = file->decoder();

  std::unique_ptr<VideoSink> sink;
  Picture picture;
  std::int64_t begin = 0;  // time in the stream that is 0 in the output
  Progress progress("decoding", std::nullopt, arguments.quiet);
  LossReport losses(progress);
  for (;;) {
    const auto status = arguments.keep_going ? losses.next(*file) : file->next();
    if (!status) return fail(status.error());
    if (*status == DecodeStatus::kEnd) break;
    if (!sink) {
      // Pictures that are lost at the beginning leave a gap, so that sound keeps its place.
      begin = static_cast<std::int64_t>(arguments.from > 0 ? decoder.position().time : decoder.start().time);
      auto opened = open_video_sink(arguments.output, decoder.format(),
                                    {arguments.sound, arguments.from > 0 ? begin : 0});
      if (!opened) return fail(opened.error());
      sink = std::move(*opened);
    }
    if (!decoder.held() || picture.empty())
      if (auto drawn = decoder.render(picture); !drawn) return fail(drawn.error());
    const std::int64_t pts = static_cast<std::int64_t>(decoder.position().time) - begin;
    if (auto written = sink->write(picture, pts); !written) return fail(written.error());
    progress.update(static_cast<std::int64_t>(decoder.pictures()));
  }
  if (!sink) return fail(ErrorCode::kInvalidStream, file->name() + ": contains no pictures");
  if (!arguments.keep_going && !decoder.announced_pictures())
    return fail(ErrorCode::kTruncated, file->name() + ": " + missing_end_text(decoder));
  progress.finish();
  if (auto finished = sink->finish(); !finished) return fail(finished.error());
  return arguments.keep_going ? losses.finish(*file) : Outcome::kComplete;
}

}  // namespace fbs::cli
