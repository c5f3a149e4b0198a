// fbs decode: stream to pictures.
#include <array>
#include <cstdio>
#include <optional>

#include "cli/decoded_time.h"
#include "cli/output_check.h"
#include "cli/progress.h"
#include "cli/stream_file.h"
#include "cli/verbs.h"
#include "cli/video/constant_rate.h"
#include "cli/video/stop_signal.h"
#include "cli/video/timestamps.h"
#include "cli/video/video_sink.h"
#include "cli/video/y4m.h"

namespace fbs::cli {
namespace {

constexpr int kMaxFaults = 1000;  // a stream with more is given up

/// Decodes one stream into one output.
class Decoding {
 public:
  /// @param stop  null: no signal is awaited
  Decoding(const DecodeArguments& arguments, const StopSignal* stop)
      : arguments_(arguments), stop_(stop), progress_("decoding", std::nullopt, arguments.quiet) {}

  Result<void> run();

 private:
  /// The next picture; false at the end of what can be decoded.
  Result<bool> next();
  Result<void> report(const Error& fault);
  Result<void> open_sink();
  Result<void> write();
  void print_rate_change() const;
  void print_missing() const;
  [[nodiscard]] StreamDecoder& decoder() { return file_->decoder(); }

  const DecodeArguments& arguments_;
  const StopSignal* stop_;
  Progress progress_;
  std::optional<StreamFile> file_;
  std::unique_ptr<VideoSink> sink_;             ///< opened with the first picture
  const ConstantRateSink* constant_ = nullptr;  ///< sink_, for outputs without timestamps
  Picture picture_;
  DecodedTime time_;
  int faults_ = 0;
};

Result<void> check_files(const DecodeArguments& a) {
  if (auto named = check_picture_name(a.output); !named) return named;
  const std::array inputs{NamedFile{"INPUT", a.input}, NamedFile{"--sound", a.sound}};
  const std::array outputs{NamedFile{"OUTPUT", a.output}};
  return check_distinct(inputs, outputs);
}

Result<void> Decoding::run() {
  if (auto checked = check_files(arguments_); !checked) return checked;
  auto file = StreamFile::open(arguments_.input, stop_);
  if (!file) return fail(file.error());
  file_.emplace(std::move(*file));
  for (;;) {
    const auto found = next();
    if (!found) return fail(found.error());
    if (!*found) break;
    if (auto written = write(); !written) return written;
  }
  if (!sink_) return fail(ErrorCode::kInvalidStream, file_->name() + ": contains no pictures");
  progress_.finish();
  if (auto finished = sink_->finish(); !finished) return finished;
  print_rate_change();
  print_missing();
  return {};
}

Result<bool> Decoding::next() {
  for (;;) {
    if (stop_ != nullptr && stop_->raised()) return fail(ErrorCode::kIo, "stopped");
    auto status = file_->next();
    if (status) return *status != DecodeStatus::kEnd;
    if (auto passed_over = report(status.error()); !passed_over) return fail(passed_over.error());
    if (status.error().code == ErrorCode::kTruncated) return false;
  }
}

/// Prints a fault that is passed over; returns it when it is not to be.
Result<void> Decoding::report(const Error& fault) {
  if (!arguments_.keep_going || fault.code == ErrorCode::kIo || fault.code == ErrorCode::kNotFbs)
    return fail(fault);
  progress_.finish();
  std::fprintf(stderr, "fbs: %s; continuing\n", fault.text.c_str());
  if (fault.code != ErrorCode::kTruncated && ++faults_ >= kMaxFaults)
    return fail(ErrorCode::kInvalidStream, file_->name() + ": too many errors, giving up");
  return {};
}

Result<void> Decoding::open_sink() {
  const VideoFormat& format = decoder().format();
  auto opened = open_video_sink(arguments_.output, format, {arguments_.sound});
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

Result<void> Decoding::write() {
  if (!sink_)
    if (auto opened = open_sink(); !opened) return opened;
  if (auto drawn = decoder().render(picture_); !drawn) return drawn;
  if (auto written = sink_->write(picture_, time_.pts()); !written) return written;
  time_.advance(decoder().duration());
  progress_.update(static_cast<std::int64_t>(decoder().pictures()));
  return {};
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

void Decoding::print_missing() const {
  const StreamDecoder& decoder = file_->decoder();
  const auto announced = decoder.announced_pictures();
  if (announced && *announced != decoder.pictures())
    std::fprintf(stderr, "fbs: %s: %llu of %llu pictures missing\n", file_->name().c_str(),
                 static_cast<unsigned long long>(*announced - decoder.pictures()),
                 static_cast<unsigned long long>(*announced));
}

}  // namespace

Result<Outcome> run_decode(const DecodeArguments& arguments) {
  // Standard output has nothing to remove: there a signal ends the program at once.
  std::optional<StopSignal> stop;
  if (arguments.output != "-") stop.emplace(nullptr);
  const auto decoded = Decoding(arguments, stop ? &*stop : nullptr).run();
  if (decoded) return Outcome::kComplete;
  if (!stop || !stop->raised()) return fail(decoded.error());
  if (!arguments.quiet) std::fprintf(stderr, "fbs: stopped by %s; nothing written\n", stop->name());
  return outcome_of_stop(stop->number());
}

}  // namespace fbs::cli
