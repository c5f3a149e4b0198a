#include "decoder/sound/sound_cursor.h"

#include <algorithm>

#include "bitstream/sound_time.h"

namespace fbs {

void SoundCursor::seek(std::int64_t time) {
  sound_ = DecodedSound(time);
  begin_ = time;
  taken_ = 0;
  const auto& all = parts_.all();
  const auto first = std::find_if(all.begin(), all.end(),
                                  [&](const SoundPart& part) { return end_of(part) > time - kSoundPreroll; });
  next_ = static_cast<std::size_t>(first - all.begin());
}

void SoundCursor::decode(std::int64_t end) {
  const auto& all = parts_.all();
  for (; next_ < all.size() && begin_of(all[next_]) < end; ++next_)
    // A codec that is unknown, or has another rate than the first, is not heard.
    static_cast<void>(sound_.add(all[next_]));
}

std::vector<std::int16_t> SoundCursor::take(std::int64_t end) {
  decode(end);
  const std::int64_t wanted = std::max<std::int64_t>((end - begin_) * sample_rate_ / kSoundClock - taken_, 0);
  const auto count = static_cast<std::size_t>(wanted * channels_);
  taken_ += wanted;
  std::vector<std::int16_t> out;
  if (sound_.sample_rate() == sample_rate_ && sound_.channels() == channels_)
    for (auto samples = sound_.take(end); !samples.empty(); samples = sound_.take(end))
      out.insert(out.end(), samples.begin(), samples.end());
  // Before the first part, the silence given is unknown to the decoder.
  if (out.size() > count) out.erase(out.begin(), out.end() - static_cast<std::ptrdiff_t>(count));
  out.resize(count);
  return out;
}

}  // namespace fbs
