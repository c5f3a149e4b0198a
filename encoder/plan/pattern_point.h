// What --quality means for a scene with several patterns: how many, and how finely each is coded.
#pragma once

namespace fbs {

struct PatternPoint {
  double per_second;   ///< patterns
  int quantiser;       ///< libaom's scale, 0..63; of patterns of CIF size
  int motion_quality;  ///< OperatingPoint::at() for the motion between them

  /// @param quality  0..100
  static PatternPoint at(int quality);

  /// The same for a scene without a face, in which all that moves is in the patterns.
  static PatternPoint without_face(int quality);
};

/// Quantiser of patterns of another size: large ones are worth fewer bits a sample.
[[nodiscard]] int quantiser_of(const PatternPoint& point, int width, int height);

/// What one step less of the quantiser multiplies a pattern's bytes by, about.
inline constexpr double kBytesPerStep = 1.045;

/// Squared luma levels that a bit of a pattern is worth at a quantiser, libaom's scale 0..63: as for video,
/// a share of the squared step of the transform's coefficients.
[[nodiscard]] double pattern_lambda(int quantiser);

/// The quantiser at which a bit is worth so many times as much as at another, 0..63.
[[nodiscard]] int quantiser_at_price(int quantiser, double price);

/// Quality of the motion that goes with a total rate.
[[nodiscard]] int motion_quality_at(double kbps);

}  // namespace fbs
