#include "encoder/plan/pattern_sizes.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

/// Natural logarithm of the factor on a pattern's bits when the quantiser is one lower: akiyo and claire,
/// quantisers 24 to 48. Whole pictures follow it only where they have not been tried: near 63 it is .17.
constexpr double kLogBitsPerStep = 0.058;

/// What changes grows with this power of the pictures since the pattern before: .2 to .6 in akiyo and claire.
constexpr double kAgePower = 0.25;

/// Assumed change within kAssumedAge pictures, as a share of the whole picture, until a pattern tells.
constexpr double kAssumedChange = 0.35;
constexpr std::size_t kAssumedAge = 6;

/// Least share of a pattern's bits that change is taken for, since refinement is an estimate.
constexpr double kLeastChange = 0.25;

/// How fast the expected change follows coded patterns.
constexpr double kLearn = 0.5;

double growth(std::size_t age) {
  return std::pow(static_cast<double>(age), kAgePower);
}

}  // namespace

PatternSizes::PatternSizes() {
  for (std::size_t q = 0; q < log_whole_.size(); ++q)
    log_whole_[q] = -kLogBitsPerStep * static_cast<double>(q);
}

void PatternSizes::set_tried(const std::map<int, std::size_t>& bytes) {
  const auto log_bits = [](const auto& tried) { return std::log(8.0 * static_cast<double>(tried.second)); };
  for (int q = 0; q < 64; ++q) {
    const auto above = bytes.lower_bound(q);
    const auto below = above == bytes.begin() ? above : std::prev(above);
    double& whole = log_whole_[static_cast<std::size_t>(q)];
    if (above == bytes.end() || above == below) {
      whole = log_bits(*below) + kLogBitsPerStep * (below->first - q);
    } else {
      const double share = (q - below->first) / static_cast<double>(above->first - below->first);
      whole = std::lerp(log_bits(*below), log_bits(*above), share);
    }
  }
}

void PatternSizes::set_whole(double bits, int quantiser) {
  const double difference = std::log(bits) - log_whole_[static_cast<std::size_t>(quantiser)];
  for (double& whole : log_whole_) whole += difference;
  finest_ = quantiser;
  if (change_ > 0) return;
  change_ = kAssumedChange * bits / growth(kAssumedAge);
  change_quantiser_ = quantiser;
}

void PatternSizes::learn(double bits, int quantiser, std::size_t age) {
  const double seen = std::max(bits - refinement(quantiser), kLeastChange * bits) / growth(age);
  const double expected = change(quantiser, 1);
  change_ = expected + kLearn * (seen - expected);
  change_quantiser_ = quantiser;
  finest_ = std::min(finest_, quantiser);
}

double PatternSizes::whole(int quantiser) const {
  return std::exp(log_whole_[static_cast<std::size_t>(quantiser)]);
}

double PatternSizes::change(int quantiser, std::size_t age) const {
  return change_ * std::exp(kLogBitsPerStep * (change_quantiser_ - quantiser)) * growth(age);
}

double PatternSizes::refinement(int quantiser) const {
  return std::max(0.0, whole(quantiser) - whole(finest_));
}

}  // namespace fbs
