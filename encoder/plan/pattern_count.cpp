#include "encoder/plan/pattern_count.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

/// Patterns that lie closer in time are predicted better: bytes fall with this power of their number. Measured
/// on the ten clips.
constexpr double kBytesExponent = 0.15;

/// A blend averages the coding errors of its patterns.
constexpr double kErrorLeft = 0.7;

double loss_at(std::span<const BlendLoss> losses, double count) {
  std::size_t k = 0;
  while (k + 2 < losses.size() && static_cast<double>(losses[k + 1].patterns) < count) ++k;
  const BlendLoss &a = losses[k], &b = losses[k + 1];
  const double slope = std::log((b.squared_error + 0.01) / (a.squared_error + 0.01)) /
                       std::log(static_cast<double>(b.patterns) / static_cast<double>(a.patterns));
  return a.squared_error * std::pow(count / static_cast<double>(a.patterns), std::min(slope, 0.0));
}

}  // namespace

PatternCount best_count(std::span<const BlendLoss> losses, const PatternRate& rate, std::size_t rate_count,
                        double samples, double lambda, std::size_t max_count) {
  PatternCount best{0, 0};
  for (std::size_t n = 2; n <= max_count; n = std::max(n + 1, n * 9 / 8)) {
    const auto count = static_cast<double>(n);
    const double later =
        rate.later_bytes * std::pow(static_cast<double>(rate_count) / count, kBytesExponent) * (count - 1);
    const double cost = samples * (loss_at(losses, count) + kErrorLeft * rate.squared_error) +
                        lambda * 8 * (rate.first_bytes + later);
    if (best.patterns == 0 || cost < best.cost) best = {n, cost};
  }
  return best;
}

}  // namespace fbs
