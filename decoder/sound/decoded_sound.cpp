#include "decoder/sound/decoded_sound.h"

#include <algorithm>
#include <utility>

#include "decoder/sound/sound_parts.h"

namespace fbs {
namespace {

/// A longer gap is not concealed: the decoder restarts after it.
constexpr std::int64_t kLongGap = kSoundClock;

}  // namespace

Result<void> DecodedSound::add(SoundPart part) {
  if (part.setup != last_setup_) {
    const auto decoder = SoundDecoder::create(part.setup);
    if (!decoder) return fail(decoder.error());
    if (sample_rate_ == 0) {
      sample_rate_ = (*decoder)->sample_rate();
      channels_ = (*decoder)->channels();
    }
    last_setup_ = part.setup;
  }
  const std::size_t size = memory_of(part.group);
  if (waiting_size_ + size > kMaxSoundAhead) return {};
  waiting_size_ += size;
  waiting_.push_back(std::move(part));
  return {};
}

void DecodedSound::decode(std::int64_t end) {
  SoundPiece piece;
  for (; !waiting_.empty() && begin_of(waiting_.front()) < end; waiting_.pop_front()) {
    SoundPart& part = waiting_.front();
    waiting_size_ -= memory_of(part.group);
    if (begin_of(part) > read_ + kLongGap) reader_.reset();
    read_ = end_of(part);
    // add() has checked that there is a decoder; a faulty frame is concealed.
    if (!reader_.set(part.setup) || !reader_.add(std::move(part.group))) continue;
    for (;;) {
      const auto more = reader_.next(piece);
      if (more && !*more) break;
      if (more) append(piece);
    }
  }
}

void DecodedSound::append(const SoundPiece& piece) {
  if (piece.sample_rate != sample_rate_ || piece.channels != channels_) return;  // files cannot change it
  const std::int64_t given = taken_ + static_cast<std::int64_t>(samples_.size()) / channels_,
                     first = place_of(piece.time),
                     end = first + static_cast<std::int64_t>(piece.samples.size()) / channels_;
  if (end <= given) return;
  if (first > given)
    samples_.insert(samples_.end(), static_cast<std::size_t>((first - given) * channels_), 0);
  const std::int64_t skipped = std::max<std::int64_t>(given - first, 0);
  samples_.insert(samples_.end(), piece.samples.begin() + skipped * channels_, piece.samples.end());
}

std::vector<std::int16_t> DecodedSound::take(std::int64_t end) {
  end = std::min(end, time_of(taken_) + kSoundClock);
  decode(end);
  const auto count = static_cast<std::size_t>(std::max<std::int64_t>(place_of(end) - taken_, 0) * channels_);
  std::vector<std::int16_t> out(count);
  const auto known = static_cast<std::ptrdiff_t>(std::min(count, samples_.size()));
  std::copy_n(samples_.begin(), known, out.begin());
  samples_.erase(samples_.begin(), samples_.begin() + known);
  taken_ += static_cast<std::int64_t>(count) / channels_;
  return out;
}

}  // namespace fbs
