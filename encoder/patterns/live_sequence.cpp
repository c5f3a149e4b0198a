#include "encoder/patterns/live_sequence.h"

#include <algorithm>
#include <utility>

#include "encoder/patterns/downscale.h"
#include "encoder/patterns/first_pattern.h"

namespace fbs {
namespace {

/// Samples per picture for which a core has time at full effort.
constexpr int kCif = 352 * 288;

/// libaom's speeds when a core has time left and when not: at CIF 6 takes 12 % more of the whole rate than 3.
constexpr int kHastySpeed = 6;
int unhurried_speed(const VideoFormat& size) {
  const int samples = size.width * size.height;
  return samples <= kCif ? 3 : samples <= 640 * 480 ? 5 : kHastySpeed;
}

/// Patterns for which there is time: two a second at CIF, and two at once. With ten, akiyo and
/// woman_presenter_700 gain .1 dB in the face at 24 kbit/s, and 640x480 takes a third more time.
constexpr double kUnhurriedSamplesPerSecond = 2 * kCif, kUnhurriedAtOnce = 2;

}  // namespace

LiveSequence::LiveSequence(const VideoFormat& format, bool reduced, bool alone)
    : format_(format), coded_(format), always_alone_(alone), alone_(alone) {
  if (!reduced) return;
  coded_.width = reduced_size(format.width);
  coded_.height = reduced_size(format.height);
}

void LiveSequence::begin_scene() {
  codec_.reset();
  first_ = {};
  alone_ = always_alone_;
}

void LiveSequence::lose_patterns() {
  if (alone_ || first_.picture.y.samples.empty()) return;
  alone_ = true;
  codec_.reset();  // the next one follows the first pattern
}

Picture LiveSequence::to_coded_size(Picture picture) const {
  return coded_.width == format_.width ? std::move(picture) : downscaled(picture);
}

int LiveSequence::speed() const {
  return coded_lately_ < kUnhurriedAtOnce ? unhurried_speed(coded_) : kHastySpeed;
}

void LiveSequence::pass(double seconds) {
  const double per_second = kUnhurriedSamplesPerSecond / (1.0 * coded_.width * coded_.height);
  coded_lately_ = std::max(0.0, coded_lately_ - per_second * seconds);
}

Result<void> LiveSequence::open(int quantiser, int speed) {
  auto av1 = Av1Encoder::create(coded_, {quantiser, speed});
  if (!av1) return fail(av1.error());
  auto decoder = PatternDecoder::create(format_.width, format_.height);
  if (!decoder) return fail(decoder.error());
  codec_.emplace(Codec{std::move(*av1), std::move(*decoder)});
  return {};
}

Result<SequencePattern> LiveSequence::code_next(const Picture& picture) {
  auto frames = codec_->encoder.encode(picture, alone_);
  if (!frames) return fail(frames.error());
  if (frames->size() != 1) return fail(ErrorCode::kInternal, "libaom holds a pattern back");
  auto decoded = codec_->decoder.decode(frames->front());
  if (!decoded) return fail(decoded.error());
  return SequencePattern{0, std::move(frames->front()), std::move(*decoded)};
}

Result<SequencePattern> LiveSequence::code(Picture picture, int quantiser) {
  picture = to_coded_size(std::move(picture));
  const int now = speed(), first_speed = std::min(now, unhurried_speed(coded_));
  const bool is_first = first_.picture.y.samples.empty();
  if (is_first) first_ = {picture, quantiser, first_speed, false};
  if (is_first || (first_.coarse && (alone_ || !codec_))) {
    if (auto opened = open(quantiser, first_speed); !opened) return fail(opened.error());
  } else {
    if (!codec_) {
      if (auto opened = open(first_.quantiser, first_.speed); !opened) return fail(opened.error());
      if (auto again = code_next(first_.picture); !again) return again;
    }
    if (auto set = codec_->encoder.set(quantiser, now); !set) return fail(set.error());
  }
  ++coded_lately_;
  return code_next(picture);
}

Result<SequencePattern> LiveSequence::code_start(const Picture& picture, int finest, std::size_t bytes) {
  const bool reduced = coded_.width != format_.width;
  auto coded = code_start_pattern(format_, picture, {finest, reduced, kTrialSpeed}, bytes);
  if (!coded) return fail(coded.error());
  first_ = {picture, finest, kTrialSpeed, true};
  ++coded_lately_;
  return SequencePattern{0, std::move(coded->av1), std::move(coded->decoded)};
}

}  // namespace fbs
