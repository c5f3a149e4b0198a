// A position in the sound of a stream, from which samples are taken in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "decoder/sound/decoded_sound.h"
#include "decoder/sound/sound_parts.h"

namespace fbs {

/// Decodes the sound of a stream from any time on, as far as requested. Faults in it become silence.
class SoundCursor {
 public:
  /// @param parts  must outlive the object; may grow
  SoundCursor(const SoundParts& parts, int sample_rate, int channels)
      : parts_(parts), sample_rate_(sample_rate), channels_(channels), sound_(0) {}

  /// @param time  of the next sample, 1/kSoundClock s; not negative
  void seek(std::int64_t time);

  /// The samples before a time that have not been taken, channels interleaved. Parts that have not arrived
  /// are silence.
  [[nodiscard]] std::vector<std::int16_t> take(std::int64_t end);

  [[nodiscard]] int sample_rate() const { return sample_rate_; }
  [[nodiscard]] int channels() const { return channels_; }

  /// Time of the next sample.
  [[nodiscard]] std::int64_t time() const { return begin_ + taken_ * kSoundClock / sample_rate_; }

 private:
  /// Decodes the parts that begin before a time.
  void decode(std::int64_t end);

  const SoundParts& parts_;
  int sample_rate_, channels_;
  DecodedSound sound_;
  std::size_t next_ = 0;    ///< index of a part
  std::int64_t begin_ = 0;  ///< of the last seek()
  std::int64_t taken_ = 0;  ///< samples per channel since then
};

}  // namespace fbs
