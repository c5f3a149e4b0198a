// The sound of a stream as samples.
#pragma once

#include <cstdint>
#include <vector>

#include "common/result.h"
#include "decoder/sound/sound_reader.h"
#include "decoder/stream_decoder.h"

namespace fbs::cli {

// Times are in 1/kSoundClock s of the stream.

/// The sound of a stream as samples without gaps. Sound comes before its pictures; it is given with them, and
/// what is after the last picture is not.
class DecodedSound {
 public:
  /// @param begin  time of the first sample: what is before is left out
  explicit DecodedSound(std::int64_t begin) : begin_(begin) {}

  Result<void> add(SoundPart part);

  /// The samples before a time that have not been taken; silence where there is no sound. Not before add().
  [[nodiscard]] std::vector<std::int16_t> take(std::int64_t end);

  [[nodiscard]] int sample_rate() const { return sample_rate_; }  ///< 0 before add()
  [[nodiscard]] int channels() const { return channels_; }

 private:
  [[nodiscard]] std::int64_t place_of(std::int64_t time) const {
    return (time - begin_) * sample_rate_ / kSoundClock;
  }
  void append(const SoundPiece& piece);

  SoundReader reader_;
  std::int64_t begin_;
  int sample_rate_ = 0, channels_ = 1;
  std::int64_t taken_ = 0;             ///< samples of each channel
  std::vector<std::int16_t> samples_;  ///< that follow
};

}  // namespace fbs::cli
