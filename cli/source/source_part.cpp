#include "cli/source/source_part.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "cli/video/open/open_video.h"

namespace fbs::cli {
namespace {

/// Whether the pictures before the error are worth keeping.
bool ends_source(const Error& error) {
  return error.code == ErrorCode::kTruncated || error.code == ErrorCode::kInvalidStream ||
         error.code == ErrorCode::kIo;
}

/// The lesser of those that are known.
template <class T>
std::optional<T> least(std::optional<T> a, std::optional<T> b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

}  // namespace

SourcePart::SourcePart(std::unique_ptr<VideoSource> source, const PartLimits& limits, const StopSignal* stop)
    : source_(std::move(source)), limits_(limits), stop_(stop) {}

Result<std::optional<TimedPicture>> SourcePart::next() {
  ended_ = ended_ || stopped() || (limits_.pictures && pictures_ >= *limits_.pictures);
  if (ended_) return std::nullopt;
  auto picture = source_->next();
  ended_ = !picture || !*picture || !within_seconds((*picture)->pts);
  if (!picture) return end_by(picture.error());
  if (ended_) return std::nullopt;
  ++pictures_;
  return picture;
}

Result<std::optional<TimedPicture>> SourcePart::end_by(const Error& error) {
  // A read interrupted by the signal fails; a partly read picture is lost.
  if (stopped()) return std::nullopt;
  if (pictures_ == 0 || !ends_source(error)) return fail(error);
  failure_ = error;
  return std::nullopt;
}

bool SourcePart::within_seconds(std::int64_t pts) {
  if (!first_pts_) first_pts_ = pts;
  if (!limits_.seconds) return true;
  return static_cast<double>(pts - *first_pts_) < *limits_.seconds * kTicksPerSecond;
}

std::optional<std::int64_t> SourcePart::most_pictures() const {
  const Rational rate = format().frame_rate;
  std::optional<std::int64_t> in_seconds;
  if (limits_.seconds) in_seconds = std::llround(std::ceil(*limits_.seconds * rate.num / rate.den));
  return least(limits_.pictures, in_seconds);
}

std::optional<std::int64_t> SourcePart::frame_count_estimate() const {
  return least(source_->frame_count_estimate(), most_pictures());
}

std::optional<double> SourcePart::seconds_estimate() const {
  const auto most = most_pictures();
  const Rational rate = format().frame_rate;
  std::optional<double> allowed;
  if (most) allowed = static_cast<double>(*most) * rate.den / rate.num;
  return least(source_->seconds_estimate(), allowed);
}

Error about_input(Error error, const std::string& name) {
  const std::string input = name == "-" ? "standard input" : name;
  if (error.code != ErrorCode::kIo && !error.text.starts_with(input)) error.text = input + ": " + error.text;
  return error;
}

Result<SourcePart> open_source_part(const std::string& name, const PartLimits& limits,
                                    std::optional<double> sequence_rate, int rotate, const StopSignal& stop) {
  if (sequence_rate && !is_image_sequence(name))
    return fail(ErrorCode::kInvalidArgument, "--rate is for images: " + name + " has its own");
  SourceOptions options;
  options.rotate = rotate;
  options.stop = &stop;
  if (sequence_rate)
    options.sequence_rate = {static_cast<std::uint32_t>(std::lround(*sequence_rate * 1000)), 1000};
  auto opened = open_video_source(name, options);
  if (!opened) return fail(opened.error());
  return SourcePart(std::move(*opened), limits, &stop);
}

void print_notes(const std::string& name, const VideoSource& source) {
  for (const std::string& note : source.notes())
    std::fprintf(stderr, "fbs: %s: %s\n", name.c_str(), note.c_str());
}

void print_source_warning(const std::string& name, const SourcePart& source, std::uint64_t pictures,
                          const char* done, bool quiet) {
  if (!quiet) print_notes(name, source);
  if (source.failure())
    std::fprintf(stderr, "fbs: %s; the %llu pictures before are %s\n", source.failure()->text.c_str(),
                 static_cast<unsigned long long>(pictures), done);
  else if (source.damaged_packets() > 0)
    std::fprintf(stderr, "fbs: %s: %lld damaged packets skipped\n", name.c_str(),
                 static_cast<long long>(source.damaged_packets()));
}

}  // namespace fbs::cli
