// The sound of a file, in step with the pictures that VideoSource returns from the same file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/result.h"

namespace fbs {

class StopSignal;

struct SoundSourceOptions {
  int sample_rate = 48000;                  ///< Hz, of the samples returned: 8000..192000
  int channels = 1;                         ///< of the samples returned: 1 or 2
  std::optional<int> track = std::nullopt;  ///< index among the sound tracks, from 0; none: the main one
  const StopSignal* stop = nullptr;         ///< must outlive the source; a read that waits ends with an error
  /// Where the sound is cut, 1/90000 s from the first picture.
  std::int64_t end = std::numeric_limits<std::int64_t>::max();
};

/// Sound resampled and mixed to the requested rate and channels. Sample n is n / sample_rate s after the
/// first picture, for as long as the source lasts: earlier sound is left out; before the sound begins, in
/// gaps and in place of damaged packets there is silence. Differences between timestamps and number of
/// samples are evened out, slow ones by resampling, those above 20 ms at once. Errors name the input.
class SoundSource {
 public:
  virtual ~SoundSource() = default;

  /// The next samples, at least one and about a second at most per channel, interleaved; nullopt at the end,
  /// also when called again. A truncated file ends early: VideoSource reports that.
  /// @return ErrorCode::kIo when reading fails, kUnsupported when the sound changes to a layout that cannot
  /// be mixed; after an error the source must not be used further
  virtual Result<std::optional<std::vector<std::int16_t>>> next() = 0;

  /// Damaged packets skipped so far; worth a warning when not zero.
  [[nodiscard]] virtual std::int64_t damaged_packets() const { return 0; }
};

/// The error of open_sound_source for a missing track.
/// @param count  number of sound tracks
inline Error missing_track(const std::string& input, int track, std::ptrdiff_t count) {
  std::string has = "no sound";
  if (count == 1) has = "one, number 0";
  if (count > 1) has = std::to_string(count) + ", from 0 to " + std::to_string(count - 1);
  return {ErrorCode::kInvalidArgument,
          input + ": no sound track " + std::to_string(track) + ": it has " + has};
}

}  // namespace fbs
