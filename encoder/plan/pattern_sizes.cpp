#include "encoder/plan/pattern_sizes.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

/// Factor on a pattern's bits when the quantiser is one lower: akiyo and claire, quantisers 24 to 48.
constexpr double kBitsPerStep = 1.06;

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

double PatternSizes::Size::at(int other_quantiser) const {
  return bits * std::pow(kBitsPerStep, quantiser - other_quantiser);
}

void PatternSizes::set_whole(double bits, int quantiser) {
  whole_ = {bits, quantiser};
  finest_ = quantiser;
  if (change_.bits == 0) change_ = {kAssumedChange * bits / growth(kAssumedAge), quantiser};
}

void PatternSizes::learn(double bits, int quantiser, std::size_t age) {
  const double seen = std::max(bits - refinement(quantiser), kLeastChange * bits) / growth(age);
  const double expected = change_.at(quantiser);
  change_ = {expected + kLearn * (seen - expected), quantiser};
  finest_ = std::min(finest_, quantiser);
}

double PatternSizes::whole(int quantiser) const {
  return whole_.at(quantiser);
}

double PatternSizes::change(int quantiser, std::size_t age) const {
  return change_.at(quantiser) * growth(age);
}

double PatternSizes::refinement(int quantiser) const {
  return std::max(0.0, whole(quantiser) - whole(finest_));
}

}  // namespace fbs
