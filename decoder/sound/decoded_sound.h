// The sound of a stream as samples.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/result.h"
#include "decoder/sound/sound_reader.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs {

// Times are in 1/kSoundClock s of the stream.

/// The sound of a stream as samples without gaps. Sound comes before its pictures and is decoded with them;
/// sound after the last picture is not. Memory is limited to kMaxSoundAhead and two seconds of samples,
/// whatever times the stream claims.
class DecodedSound {
 public:
  /// @param begin  time of the first sample: earlier sound is left out
  explicit DecodedSound(std::int64_t begin) : begin_(begin) {}

  /// A part too far ahead of the samples taken (kMaxSoundAhead) is left out.
  /// @return errors of SoundDecoder::create
  Result<void> add(SoundPart part);

  /// The next samples before a time, at most a second; silence where there is no sound. Not before add().
  /// @return empty when all samples before it have been taken
  [[nodiscard]] std::vector<std::int16_t> take(std::int64_t end);

  [[nodiscard]] int sample_rate() const { return sample_rate_; }  ///< 0 before add()
  [[nodiscard]] int channels() const { return channels_; }

 private:
  [[nodiscard]] std::int64_t place_of(std::int64_t time) const {
    return (time - begin_) / (kSoundClock / sample_rate_);
  }
  [[nodiscard]] std::int64_t time_of(std::int64_t place) const {
    return begin_ + place * (kSoundClock / sample_rate_);
  }
  /// Decodes the parts that begin before a time.
  void decode(std::int64_t end);
  void append(const SoundPiece& piece);

  std::int64_t begin_;
  int sample_rate_ = 0, channels_ = 1;
  std::deque<SoundPart> waiting_;         ///< parts not yet decoded
  std::size_t waiting_size_ = 0;          ///< memory_of() waiting_
  std::optional<SoundSetup> last_setup_;  ///< the last one given to add()
  SoundReader reader_;
  std::int64_t read_ = 0;              ///< end of the last part decoded
  std::int64_t taken_ = 0;             ///< samples per channel
  std::vector<std::int16_t> samples_;  ///< the samples after taken_
};

}  // namespace fbs
