#include "cli/stream/decoded_sound.h"

#include <algorithm>
#include <utility>

namespace fbs::cli {

Result<void> DecodedSound::add(SoundPart part) {
  if (auto set = reader_.set(part.setup); !set) return set;
  if (auto added = reader_.add(std::move(part.group)); !added) return added;
  SoundPiece piece;
  for (;;) {
    const auto more = reader_.next(piece);
    if (more && !*more) return {};
    if (more) append(piece);  // else the frame is concealed by the next call
  }
}

void DecodedSound::append(const SoundPiece& piece) {
  if (sample_rate_ == 0) {
    sample_rate_ = piece.sample_rate;
    channels_ = piece.channels;
  }
  if (piece.sample_rate != sample_rate_ || piece.channels != channels_) return;  // no file can change
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
  const auto count = static_cast<std::size_t>(std::max<std::int64_t>(place_of(end) - taken_, 0) * channels_);
  std::vector<std::int16_t> out(count);
  const auto known = static_cast<std::ptrdiff_t>(std::min(count, samples_.size()));
  std::copy_n(samples_.begin(), known, out.begin());
  samples_.erase(samples_.begin(), samples_.begin() + known);
  taken_ += static_cast<std::int64_t>(count) / channels_;
  return out;
}

}  // namespace fbs::cli
