// Rate-distortion curves: the envelope of points, its quality at a rate, and the Bjontegaard measure.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace fbs::cli {

struct CurvePoint {
  double kbps = 0;     ///< above 0
  double quality = 0;  ///< dB, for instance; more is better
  friend bool operator==(const CurvePoint&, const CurvePoint&) = default;
};

/// Rises strictly in rate and quality.
using Curve = std::vector<CurvePoint>;

/// The points that no other point beats at the same or a lower rate.
[[nodiscard]] Curve envelope(std::span<const CurvePoint> points);

/// Quality at a rate, linear over log rate between two points.
/// @return nothing outside the curve's rates
[[nodiscard]] std::optional<double> quality_at(const Curve& curve, double kbps);

/// Mean difference in rate at equal quality.
struct RateDifference {
  double percent = 0;        ///< below 0: `test` needs less
  double low = 0, high = 0;  ///< range of qualities that both curves share, over which the mean is taken
};

/// Bjontegaard, *Calculation of Average PSNR Differences between RD-curves*, VCEG-M33, 2001: the mean
/// distance of the logarithms of rate over the common range of quality. Interpolated by PCHIP (Fritsch and
/// Butland 1984), as in the common test conditions of HEVC and VVC, rather than by one cubic. The integral is
/// exact.
/// @return nothing for curves of fewer than four points, or without a common range
[[nodiscard]] std::optional<RateDifference> bd_rate(const Curve& anchor, const Curve& test);

}  // namespace fbs::cli
