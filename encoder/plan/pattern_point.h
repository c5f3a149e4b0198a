// What --quality means for a scene with several patterns: their number and quantiser.
#pragma once

#include <cstdint>

#include "encoder/settings.h"

namespace fbs {

struct PatternPoint {
  double per_second;   ///< patterns
  int quantiser;       ///< libaom's scale, 0..63; for patterns of CIF size
  int motion_quality;  ///< OperatingPoint::at() for the motion between them

  /// @param quality  0..100
  static PatternPoint at(int quality);

  /// The same for patterns with less contrast outside the face: finer ones take as many bytes.
  static PatternPoint by_eye(int quality);

  /// The same for a scene without a face, where the patterns show all motion.
  static PatternPoint without_face(int quality);
};

/// Setup::contrast of a scene with look-ahead. by_eye() goes with that of Tune::kEye.
[[nodiscard]] std::int32_t surround_contrast(Tune tune);

/// What is wanted of Setup::chroma_contrast: AV1 has one quantiser for luma and chroma.
[[nodiscard]] std::int32_t chroma_contrast(Tune tune);

/// Quantiser for patterns of another size: large ones get fewer bits per sample.
[[nodiscard]] int quantiser_of(const PatternPoint& point, int width, int height);

/// Approximate factor on a pattern's bytes when the quantiser is one lower.
inline constexpr double kBytesPerStep = 1.045;

/// Squared luma levels that a bit of a pattern is worth at a quantiser, libaom's scale 0..63: as for video, a
/// share of the squared step of the transform's coefficients.
[[nodiscard]] double pattern_lambda(int quantiser);

/// Quality of the motion that goes with a total rate. Live, patterns are not solved for, and finer motion
/// pays:
/// +.6 dB in the face at 24 kbit/s (three clips).
[[nodiscard]] int motion_quality_at(double kbps, bool live);

}  // namespace fbs
