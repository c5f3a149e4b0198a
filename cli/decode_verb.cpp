// fbs decode: stream to pictures.
#include <cstdio>

#include "cli/progress.h"
#include "cli/stream_file.h"
#include "cli/verbs.h"
#include "cli/video/video_sink.h"

namespace fbs::cli {

Result<void> run_decode(const DecodeArguments& arguments) {
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  StreamDecoder& decoder = file->decoder();

  std::unique_ptr<VideoSink> sink;
  Picture picture;
  std::int64_t pts = 0;
  int faults = 0;
  Progress progress("decoding", std::nullopt, arguments.quiet);
  for (;;) {
    auto status = file->next();
    if (!status) {
      if (!arguments.keep_going || status.error().code == ErrorCode::kIo ||
          status.error().code == ErrorCode::kNotFbs)
        return fail(status.error());
      progress.finish();
      std::fprintf(stderr, "fbs: %s; continuing\n", status.error().text.c_str());
      if (status.error().code == ErrorCode::kTruncated) break;
      if (++faults >= 1000)
        return fail(ErrorCode::kInvalidStream, file->name() + ": too many errors, giving up");
      continue;
    }
    if (*status == DecodeStatus::kEnd) break;
    if (!sink) {
      auto opened = open_video_sink(arguments.output, decoder.format(), {arguments.sound});
      if (!opened) return fail(opened.error());
      sink = std::move(*opened);
    }
    if (auto drawn = decoder.render(picture); !drawn) return drawn;
    if (auto written = sink->write(picture, pts); !written) return written;
    pts += decoder.duration();
    progress.update(static_cast<std::int64_t>(decoder.pictures()));
  }
  if (!sink) return fail(ErrorCode::kInvalidStream, file->name() + ": contains no pictures");
  progress.finish();
  if (auto finished = sink->finish(); !finished) return finished;
  const auto announced = decoder.announced_pictures();
  if (announced && *announced != decoder.pictures())
    std::fprintf(stderr, "fbs: %s: %llu of %llu pictures missing\n", file->name().c_str(),
                 static_cast<unsigned long long>(*announced - decoder.pictures()),
                 static_cast<unsigned long long>(*announced));
  return {};
}

}  // namespace fbs::cli
