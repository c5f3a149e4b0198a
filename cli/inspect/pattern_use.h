// The patterns of a stream, and their shares in its pictures.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/state.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

/// Sums up the blends of pictures as they are decoded.
class PatternUse {
 public:
  /// @param decoder  records its patterns; must outlive the object
  explicit PatternUse(const StreamDecoder& decoder) : decoder_(decoder) {}

  /// Adds the current picture of the decoder.
  void add_picture();

  /// Share of the pattern in the region, over all pictures that have it.
  /// @param pattern  index into the decoder's records
  [[nodiscard]] double share(std::size_t pattern, Region region) const;

  /// When the picture that a pattern shows is displayed, seconds.
  [[nodiscard]] double seconds(std::size_t pattern) const;

 private:
  const StreamDecoder& decoder_;
  std::vector<std::array<std::int64_t, kRegionCount>> weights_;  ///< of each pattern
  std::array<std::int64_t, kRegionCount> pictures_{};            ///< pictures that have the region
  std::vector<double> times_;                                    ///< of each picture, seconds
  double end_ = 0;
};

}  // namespace fbs::cli
