// What --quality means for a scene with several patterns: how many, and how finely each is coded.
#pragma once

#include <cstddef>
#include <vector>

namespace fbs {

struct PatternPoint {
  double per_second;   ///< patterns
  int quantiser;       ///< libaom's scale, 0..63; of patterns of CIF size
  int motion_quality;  ///< OperatingPoint::at() for the motion between them

  /// @param quality  0..100
  static PatternPoint at(int quality);
};

/// Quantiser of patterns of another size: large ones are worth fewer bits a sample.
[[nodiscard]] int quantiser_of(const PatternPoint& point, int width, int height);

/// Quality of the motion that goes with a total rate.
[[nodiscard]] int motion_quality_at(double kbps);

/// Numbers of pictures at regular distances, the first and the last among them, rising.
/// @param count  wanted; as many as there are pictures at most
[[nodiscard]] std::vector<std::size_t> regular_times(std::size_t pictures, std::size_t count);

}  // namespace fbs
