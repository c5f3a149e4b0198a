#include "encoder/sound/sound_encoder.h"

#include <algorithm>

#include "encoder/sound/codec2_coder.h"
#include "encoder/sound/opus_coder.h"

namespace fbs {

Result<std::unique_ptr<SoundEncoder>> SoundEncoder::create(const SoundSettings& settings) {
  switch (settings.codec) {
    case SoundCodec::kOpus:
      return create_opus_coder(settings);
    case SoundCodec::kCodec2:
      return create_codec2_coder(settings);
  }
  return fail(ErrorCode::kInvalidArgument, "unknown codec of sound");
}

std::size_t SoundEncoder::samples_of(std::int32_t ticks) const {
  const auto rate = static_cast<std::int64_t>(sample_rate_) * setup_.channels;
  return static_cast<std::size_t>(ticks * rate / kSoundClock);
}

Result<void> SoundEncoder::encode_waiting(Frames& frames) {
  auto encoded = encode(waiting_);
  if (!encoded) return fail(encoded.error());
  frames.push_back(std::move(*encoded));
  waiting_.clear();
  return {};
}

Result<void> SoundEncoder::add(std::span<const std::int16_t> samples, Frames& frames) {
  const std::size_t frame = samples_of(setup_.duration);
  added_ = added_ || !samples.empty();
  while (!samples.empty()) {
    const std::size_t count = std::min(samples.size(), frame - waiting_.size());
    waiting_.insert(waiting_.end(), samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(count));
    samples = samples.subspan(count);
    if (waiting_.size() < frame) break;
    auto encoded = encode_waiting(frames);
    if (!encoded) return encoded;
  }
  return {};
}

Result<void> SoundEncoder::finish(Frames& frames) {
  if (!added_) return {};
  const std::vector<std::int16_t> silence(samples_of(setup_.skip));
  auto delayed = add(silence, frames);
  if (!delayed || waiting_.empty()) return delayed;
  waiting_.resize(samples_of(setup_.duration));
  return encode_waiting(frames);
}

}  // namespace fbs
