// fbs decode: stream to pictures.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bitstream/sound_time.h"
#include "cli/decode/decode_arguments.h"
#include "cli/decode/decoded_time.h"
#include "cli/decode/sound_output.h"
#include "cli/decode/thumbnail.h"
#include "cli/files/output_check.h"
#include "cli/files/stop_signal.h"
#include "cli/program/progress.h"
#include "cli/stream/loss_report.h"
#include "cli/stream/stream_file.h"
#include "cli/video/constant_rate.h"
#include "cli/video/open/open_video.h"
#include "cli/video/timestamps.h"
#include "cli/video/wav_sink.h"
#include "cli/video/y4m/y4m.h"
#include "common/md5.h"
#include "common/workers.h"

namespace fbs::cli {
namespace {

const std::string kNoOutput = "null:";

bool is_wave_name(const std::string& output) {
  return extension_of(output) == ".wav";
}

/// Decodes one stream into one output.
class Decoding {
 public:
  /// @param stop  null: ignore signals
  Decoding(const DecodeArguments& arguments, const StopSignal* stop)
      : arguments_(arguments),
        stop_(stop),
        progress_("decoding", std::nullopt, arguments.quiet),
        losses_(progress_) {}

  Result<Outcome> run();

 private:
  /// Decodes the next picture; false at the end of what can be decoded.
  Result<bool> next();
  Result<void> open_sink();
  /// Checks that the silence before the current picture can be filled.
  Result<void> check_silence();
  /// Writes the sound up to the end of the current picture.
  Result<void> write_sound();
  Result<void> write();
  /// Writes a .wav: the sound alone.
  Result<void> write_wave();
  Result<void> finish();
  void print_md5() const;
  void print_rate_change() const;
  [[nodiscard]] StreamDecoder& decoder() { return file_->decoder(); }
  [[nodiscard]] bool is_wave() const { return is_wave_name(arguments_.output); }
  /// Where the output begins in the stream: at the picture decoded first, or where pictures before it are
  /// lost, at the first of those, so that sound keeps its place. 1/90000 s.
  [[nodiscard]] std::uint64_t begin() const {
    const StreamDecoder& decoder = file_->decoder();
    return arguments_.from > 0 ? decoder.position().time : decoder.start().time;
  }

  const DecodeArguments& arguments_;
  const StopSignal* stop_;
  Progress progress_;
  LossReport losses_;
  std::optional<StreamFile> file_;
  std::unique_ptr<VideoSink> sink_;             ///< opened with the first picture
  const ConstantRateSink* constant_ = nullptr;  ///< sink_, for outputs without timestamps
  std::optional<SinkSound> sound_;              ///< for a sink that takes sound
  std::optional<DecodedSound> samples_;         ///< for a .wav
  std::unique_ptr<WavSink> wave_;               ///< likewise, opened with the first sound
  Picture picture_;
  DecodedTime time_;        ///< of the pictures written
  std::int64_t gaps_ = 0;   ///< missing pictures that are not held, 1/90000 s
  std::uint64_t next_ = 0;  ///< time in the stream of the next picture if nothing is missing
};

/// The longest time without pictures that is filled with silence, 1/90000 s: an hour. Damaged streams may
/// claim anything.
constexpr std::uint64_t kLongestSilence = std::uint64_t{3600} * kTicksPerSecond;

Result<void> check_files(const DecodeArguments& a) {
  if (a.output.empty() && !a.md5) return fail(ErrorCode::kInvalidArgument, "OUTPUT is required, or --md5");
  if (a.output == "-" && a.md5)
    return fail(ErrorCode::kInvalidArgument, "--md5: standard output has the pictures already");
  if (a.thumbnail > 0 && (a.output == "-" || a.output == kNoOutput))
    return fail(ErrorCode::kInvalidArgument, "--thumbnail needs a file as OUTPUT");
  if (auto named = check_picture_name(a.output); !named) return named;
  if (a.vfr && !is_y4m_output(a.output))
    return fail(ErrorCode::kInvalidArgument,
                "--vfr needs a Y4M as OUTPUT: others have each picture once anyway");
  if (a.no_sound && !has_sound_track(a.output))
    return fail(ErrorCode::kInvalidArgument, "--no-sound is for .mp4 and .mkv");
  if (is_wave_name(a.output) && (a.md5 || !a.sound.empty()))
    return fail(ErrorCode::kInvalidArgument, std::string(a.md5 ? "--md5" : "--sound") +
                                                 ": a .wav has the stream's own sound and no pictures");
  const std::array inputs{NamedFile{"INPUT", a.input}, NamedFile{"--sound", a.sound}};
  const std::array outputs{NamedFile{"OUTPUT", a.output}};
  return check_distinct(inputs, outputs);
}

/// More threads than this would wait for packets to be read.
constexpr int kMostThreads = 16;

int thread_count(int asked) {
  return asked > 0 ? asked : std::min(core_count(), kMostThreads);
}

Result<Outcome> Decoding::run() {
  auto file = StreamFile::open(arguments_.input, stop_);
  if (!file) return fail(file.error());
  file_.emplace(std::move(*file));
  decoder().use_threads(thread_count(arguments_.threads));
  decoder().keep_sound();
  if (arguments_.from > 0)
    if (auto sought = file_->seek(ticks(arguments_.from)); !sought) return fail(sought.error());
  for (;;) {
    const auto found = next();
    if (!found) return fail(found.error());
    if (!*found) break;
    if (auto written = is_wave() ? write_wave() : write(); !written) return fail(written.error());
  }
  if (is_wave() && !wave_) return fail(ErrorCode::kUnsupported, file_->name() + ": has no sound");
  if (!is_wave() && !sink_) return fail(ErrorCode::kInvalidStream, file_->name() + ": contains no pictures");
  if (!arguments_.keep_going && !decoder().announced_pictures())
    return fail(ErrorCode::kTruncated, file_->name() + ": " + missing_end_text(decoder()));
  progress_.finish();
  if (arguments_.md5)  // while the output can still be withdrawn
    if (auto printed = flush_standard_output(); !printed) return fail(printed.error());
  if (auto finished = finish(); !finished) return fail(finished.error());
  print_rate_change();
  return arguments_.keep_going ? losses_.finish(*file_) : Outcome::kComplete;
}

Result<bool> Decoding::next() {
  if (stop_ != nullptr && stop_->raised()) return fail(ErrorCode::kIo, "stopped");
  const auto status = arguments_.keep_going ? losses_.next(*file_) : file_->next();
  if (!status) return fail(status.error());
  return *status != DecodeStatus::kEnd;
}

Result<void> Decoding::open_sink() {
  const VideoFormat& format = decoder().format();
  next_ = begin();
  const std::string& output = arguments_.output.empty() ? kNoOutput : arguments_.output;
  SinkOptions options{arguments_.sound, static_cast<std::int64_t>(next_)};
  std::vector<SoundPart> sound = decoder().take_sound();
  if (arguments_.sound.empty() && !arguments_.no_sound && has_sound_track(output) &&
      decoder().sound_setup()) {
    auto created = SinkSound::create(*decoder().sound_setup(), sound, sound_time(options.sound_begin));
    if (!created) return fail(created.error());
    sound_.emplace(std::move(*created));
    options.sound = sound_->setup();
    for (SoundPart& part : sound)
      if (auto added = sound_->add(std::move(part)); !added) return added;
  }
  auto opened = open_video_sink(output, format, options);
  if (!opened) return fail(opened.error());
  sink_ = std::move(*opened);
  if (sink_->replaced_leftover()) print_replaced_leftover(arguments_.output);
  time_ = DecodedTime(format.frame_rate);
  if (is_y4m_output(arguments_.output) && plausible_rate(format.frame_rate)) {
    auto constant = std::make_unique<ConstantRateSink>(std::move(sink_), format.frame_rate, !arguments_.vfr);
    constant_ = constant.get();
    sink_ = std::move(constant);
  }
  return {};
}

Result<void> Decoding::check_silence() {
  const std::uint64_t silence = decoder().position().time - next_;
  if (silence <= kLongestSilence) return {};
  return fail(ErrorCode::kTooLarge, file_->name() + ": " + std::to_string(silence / kTicksPerSecond / 3600) +
                                        " hours are missing, too many to be filled with silence; --from "
                                        "begins behind them");
}

Result<void> Decoding::write_sound() {
  for (SoundPart& part : decoder().take_sound())
    if (sound_)
      if (auto added = sound_->add(std::move(part)); !added) return added;
  if (!sound_) return {};
  if (sound_->fills_gaps())
    if (auto checked = check_silence(); !checked) return checked;
  const std::uint64_t end = decoder().position().time + decoder().duration();
  return sound_->write(sound_time(static_cast<std::int64_t>(end)), *sink_);
}

Result<void> Decoding::write_wave() {
  if (!samples_) {
    next_ = begin();
    samples_.emplace(sound_time(static_cast<std::int64_t>(next_)));
  }
  if (auto checked = check_silence(); !checked) return checked;
  next_ = decoder().position().time + decoder().duration();
  for (SoundPart& part : decoder().take_sound())
    if (auto added = samples_->add(std::move(part)); !added) return added;
  if (samples_->sample_rate() == 0) return {};
  if (!wave_) {
    auto created = WavSink::create(arguments_.output, samples_->sample_rate(), samples_->channels());
    if (!created) return fail(created.error());
    wave_ = std::move(*created);
    if (wave_->replaced_leftover()) print_replaced_leftover(arguments_.output);
  }
  progress_.update(static_cast<std::int64_t>(decoder().pictures()));
  const std::int64_t end = sound_time(static_cast<std::int64_t>(next_));
  for (auto samples = samples_->take(end); !samples.empty(); samples = samples_->take(end))
    if (auto written = wave_->write(samples); !written) return written;
  return {};
}

Result<void> Decoding::finish() {
  if (wave_) return wave_->finish();
  if (sound_)
    if (auto finished = sound_->finish(*sink_); !finished) return finished;
  return sink_->finish();
}

Result<void> Decoding::write() {
  if (!sink_)
    if (auto opened = open_sink(); !opened) return opened;
  if (!decoder().held() || picture_.empty())
    if (auto drawn = decoder().render(picture_); !drawn) return drawn;
  const std::uint64_t now = decoder().position().time;
  gaps_ += static_cast<std::int64_t>(now - next_);
  if (auto written = sink_->write(picture_, gaps_ + time_.pts()); !written) return written;
  if (auto sound = write_sound(); !sound) return sound;
  if (arguments_.md5) print_md5();
  time_.advance(decoder().duration());
  next_ = now + decoder().duration();
  progress_.update(static_cast<std::int64_t>(decoder().pictures()));
  return {};
}

void Decoding::print_md5() const {
  Md5 md5;
  md5.add(picture_);
  std::printf("%s %llu\n", md5.hex().c_str(),
              static_cast<unsigned long long>(file_->decoder().position().pictures));
}

void Decoding::print_rate_change() const {
  if (constant_ == nullptr || !constant_->change().any()) return;
  const RateChange& change = constant_->change();
  const std::string output = arguments_.output == "-" ? "standard output" : arguments_.output;
  if (arguments_.vfr)
    std::fprintf(stderr, "fbs: %s: variable frame rate, each picture written once; the speed is lost\n",
                 output.c_str());
  else
    std::fprintf(
        stderr, "fbs: %s: variable frame rate made constant; pictures repeated: %lld, dropped: %lld\n",
        output.c_str(), static_cast<long long>(change.repeated), static_cast<long long>(change.dropped));
}

}  // namespace

Result<Outcome> run_decode(const DecodeArguments& arguments) {
  if (auto checked = check_files(arguments); !checked) return fail(checked.error());
  if (arguments.thumbnail > 0) return write_thumbnail(arguments).map([] { return Outcome::kComplete; });
  // Standard output leaves nothing to remove: a signal ends the program at once.
  std::optional<StopSignal> stop;
  if (arguments.output != "-") stop.emplace(nullptr);
  auto decoded = Decoding(arguments, stop ? &*stop : nullptr).run();
  if (decoded || !stop || !stop->raised()) return decoded;
  if (!arguments.quiet) std::fprintf(stderr, "fbs: stopped by %s; nothing written\n", stop->name());
  return outcome_of_stop(stop->number());
}

}  // namespace fbs::cli
