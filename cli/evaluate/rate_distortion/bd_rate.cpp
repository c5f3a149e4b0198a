#include "cli/evaluate/rate_distortion/bd_rate.h"

#include <math.h>  // NOLINT(modernize-deprecated-headers): Boost 1.74 takes isnan from the global namespace

#include <algorithm>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

namespace fbs::cli {
namespace {

using Values = std::vector<double>;
using LogRate = boost::math::interpolators::pchip<Values>;

constexpr std::size_t kMinPoints = 4;  // required by PCHIP's implementation, and by VCEG-M33

/// Slope at the end of the first of two intervals of lengths h0, h1 and slopes d0, d1, of the parabola
/// through the three points, kept monotone. Boost uses d0, the JCT-VC sheets and scipy this.
double end_slope(double h0, double h1, double d0, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0) return 0;
  if (d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0)) return 3 * d0;
  return slope;
}

LogRate log_rate_over_quality(const Curve& curve) {
  Values x, y;
  for (const CurvePoint& p : curve) {
    x.push_back(p.quality);
    y.push_back(std::log(p.kbps));
  }
  const auto length = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / length(i); };
  const std::size_t last = x.size() - 2;
  const double left = end_slope(length(0), length(1), slope(0), slope(1));
  const double right = end_slope(length(last), length(last - 1), slope(last), slope(last - 1));
  return {std::move(x), std::move(y), left, right};
}

/// Exact: Simpson's rule has no error on a cubic, and the ends of the cubics are integration limits.
double integral(const Curve& curve, double low, double high) {
  const LogRate f = log_rate_over_quality(curve);
  Values limits{low};
  for (const CurvePoint& p : curve)
    if (p.quality > low && p.quality < high) limits.push_back(p.quality);
  limits.push_back(high);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
    const double a = limits[i], b = limits[i + 1];
    sum += (b - a) / 6 * (f(a) + 4 * f((a + b) / 2) + f(b));
  }
  return sum;
}

}  // namespace

Curve envelope(std::span<const CurvePoint> points) {
  std::vector<CurvePoint> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), [](const CurvePoint& a, const CurvePoint& b) {
    return a.kbps != b.kbps ? a.kbps < b.kbps : a.quality > b.quality;
  });
  Curve out;
  for (const CurvePoint& p : sorted)
    if (out.empty() || p.quality > out.back().quality) out.push_back(p);
  return out;
}

std::optional<double> quality_at(const Curve& curve, double kbps) {
  if (curve.empty() || kbps < curve.front().kbps || kbps > curve.back().kbps) return std::nullopt;
  const auto after = std::upper_bound(curve.begin(), curve.end(), kbps,
                                      [](double rate, const CurvePoint& p) { return rate < p.kbps; });
  if (after == curve.end()) return curve.back().quality;
  const CurvePoint &a = *(after - 1), &b = *after;
  const double share = std::log(kbps / a.kbps) / std::log(b.kbps / a.kbps);
  return a.quality + share * (b.quality - a.quality);
}

std::optional<RateDifference> bd_rate(const Curve& anchor, const Curve& test) {
  if (anchor.size() < kMinPoints || test.size() < kMinPoints) return std::nullopt;
  const double low = std::max(anchor.front().quality, test.front().quality);
  const double high = std::min(anchor.back().quality, test.back().quality);
  if (high <= low) return std::nullopt;
  const double mean = (integral(test, low, high) - integral(anchor, low, high)) / (high - low);
  return RateDifference{100 * (std::exp(mean) - 1), low, high};
}

}  // namespace fbs::cli
