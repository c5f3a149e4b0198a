#include "decoder/sound/sound_reader.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

namespace fbs {
namespace {

void fade_out(std::span<std::int16_t> samples, int channels) {
  const auto step = static_cast<std::size_t>(channels);
  const auto frames = static_cast<std::int32_t>(samples.size() / step);
  for (std::int32_t i = 0; i < frames; ++i)
    for (std::int16_t& sample : samples.subspan(static_cast<std::size_t>(i) * step, step))
      sample = static_cast<std::int16_t>(sample * (frames - i) / frames);
}

}  // namespace

Result<void> SoundReader::set(const SoundSetup& setup) {
  assert(!has_frame());
  if (decoder_ && setup == setup_) return {};
  decoder_.reset();
  auto decoder = SoundDecoder::create(setup);
  if (!decoder) return fail(decoder.error());
  decoder_ = std::move(*decoder);
  setup_ = setup;
  next_frame_ = 0;
  decoded_ = false;
  return {};
}

Result<void> SoundReader::add(SoundGroup group) {
  assert(!has_frame());
  if (!decoder_) return fail(ErrorCode::kInvalidStream, "sound before what it is coded with");
  const auto frames = static_cast<std::int64_t>(group.frames.size());
  if (group.first < 0 || frames > kMaxSoundFrames || group.first > kMaxSoundFrames - frames)
    return fail(ErrorCode::kInvalidStream, "a number of a frame of sound is out of range");
  const std::int64_t known = std::clamp<std::int64_t>(next_frame_ - group.first, 0, frames);
  group_ = std::move(group);
  index_ = static_cast<std::size_t>(known);
  frame_ = group_.first + known;
  if (!begun_) given_ = std::max<std::int64_t>(0, frame_time());
  return {};
}

Result<bool> SoundReader::next(SoundPiece& piece) {
  piece.samples.clear();
  while (has_frame()) {
    const std::int64_t time = frame_time();
    if (given_ < time && begun_) return fill(time, piece);
    auto right = decode_frame(piece.samples);
    if (!right) {
      piece.samples.clear();
      return fail(right.error());
    }
    ++index_;
    next_frame_ = ++frame_;
    if (give(time, time + setup_.duration, piece)) return true;
  }
  return false;
}

void SoundReader::reset() {
  if (decoder_) decoder_->reset();
  group_ = {};
  index_ = 0;
  next_frame_ = 0;
  begun_ = decoded_ = false;
  concealed_ = 0;
}

/// Fills at most a frame's worth of the gap before `end`.
Result<bool> SoundReader::fill(std::int64_t end, SoundPiece& piece) {
  const std::int64_t time = given_;
  const auto concealed = conceal(piece.samples);
  if (!concealed) return fail(concealed.error());
  if (!give(time, std::min(end, time + setup_.duration), piece)) given_ = end;  // less than a sample
  return !piece.samples.empty() ? Result<bool>(true) : next(piece);
}

Result<void> SoundReader::decode_frame(std::vector<std::int16_t>& out) {
  std::vector<std::uint8_t>& frame = group_.frames[index_];
  if (frame.empty()) return conceal(out);
  auto decoded = decoder_->decode(frame, out);
  if (!decoded) {
    frame.clear();  // lost
    return decoded;
  }
  decoded_ = true;
  concealed_ = 0;
  return {};
}

Result<void> SoundReader::conceal(std::vector<std::int16_t>& out) {
  const bool audible = decoded_ && concealed_ < kConcealedSound;
  concealed_ += setup_.duration;
  if (!audible) {
    out.resize(decoder_->frame_samples() * static_cast<std::size_t>(decoder_->channels()));
    return {};
  }
  auto decoded = decoder_->decode({}, out);
  if (decoded && concealed_ >= kConcealedSound) fade_out(out, decoder_->channels());  // silence follows
  return decoded;
}

/// Trims a frame's samples, which begin at `time`, to those from `given_` to before `end`.
/// @return whether any are left
bool SoundReader::give(std::int64_t time, std::int64_t end, SoundPiece& piece) {
  const std::int64_t ticks = kSoundClock / decoder_->sample_rate();
  const auto samples = static_cast<std::int64_t>(decoder_->frame_samples());
  const std::int64_t first = std::clamp<std::int64_t>((given_ - time + ticks - 1) / ticks, 0, samples);
  const std::int64_t last = std::clamp<std::int64_t>((end - time) / ticks, first, samples);
  piece.time = time + first * ticks;
  piece.sample_rate = decoder_->sample_rate();
  piece.channels = decoder_->channels();
  piece.samples.erase(piece.samples.begin() + last * piece.channels, piece.samples.end());
  piece.samples.erase(piece.samples.begin(), piece.samples.begin() + first * piece.channels);
  if (first == last) return false;
  given_ = piece.time + (last - first) * ticks;
  begun_ = true;
  return true;
}

}  // namespace fbs
