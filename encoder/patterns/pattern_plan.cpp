#include "encoder/patterns/pattern_plan.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

/// Twice the patterns are nearer to each other and cost less each: median of the ten clips.
constexpr double kBytesExponent = -0.25;

/// Of the error of a pattern, what is left in a blend of several; and how much more the face has of it.
constexpr double kErrorLeft = 0.7, kFaceError = 1.3;

/// Quantisers that are considered. Below, patterns cost more than any clip repays at the rates of fbs.
constexpr int kMinQuantiser = 30, kMaxQuantiser = 63;

double between(double a, double b, double share) {
  return a + share * (b - a);
}

/// Losses are a power of the number of patterns between those that are known.
BlendLoss loss_at(std::span<const BlendLoss> losses, double patterns) {
  std::size_t k = 1;
  while (k + 1 < losses.size() && static_cast<double>(losses[k].patterns) < patterns) ++k;
  if (losses.size() == 1) return losses[0];
  const BlendLoss &a = losses[k - 1], &b = losses[k];
  const double log_a = std::log(a.patterns), log_b = std::log(b.patterns);
  const double share = (std::log(patterns) - log_a) / (log_b - log_a);
  const auto mix = [&](double x, double y) {
    return std::exp(between(std::log(std::max(x, 1e-3)), std::log(std::max(y, 1e-3)), share));
  };
  return {0, mix(a.face, b.face), mix(a.frame, b.frame)};
}

/// Sum of the logarithms of the errors: face and frame count alike, whatever their level.
double log_error(const BlendLoss& loss, double coding_error) {
  return std::log(loss.face + kErrorLeft * kFaceError * coding_error) +
         std::log(loss.frame + kErrorLeft * coding_error);
}

}  // namespace

CodingCosts::CodingCosts(std::span<const QuantiserTrial> trials, std::size_t patterns)
    : patterns_(static_cast<double>(patterns)) {
  const auto log = [](double v) { return std::log(std::max(v, 1e-3)); };
  for (const QuantiserTrial& t : trials)
    trials_.push_back({static_cast<double>(t.quantiser), log(t.cost.first_bytes), log(t.cost.later_bytes),
                       log(t.cost.squared_error)});
}

CodingCosts::Logs CodingCosts::at(int quantiser) const {
  if (trials_.size() == 1) return trials_[0];
  std::size_t k = 1;
  while (k + 1 < trials_.size() && trials_[k].quantiser < quantiser) ++k;
  const Logs &a = trials_[k - 1], &b = trials_[k];
  const double share = (quantiser - a.quantiser) / (b.quantiser - a.quantiser);
  return {static_cast<double>(quantiser), between(a.first, b.first, share), between(a.later, b.later, share),
          between(a.error, b.error, share)};
}

double CodingCosts::bytes(std::size_t patterns, int quantiser) const {
  const Logs logs = at(quantiser);
  const auto n = static_cast<double>(patterns);
  return std::exp(logs.first) + (n - 1) * std::exp(logs.later) * std::pow(n / patterns_, kBytesExponent);
}

double CodingCosts::squared_error(int quantiser) const {
  return std::exp(at(quantiser).error);
}

PatternPlan plan_patterns(const PlanInput& input) {
  PatternPlan best{}, cheapest{};
  double least_error = 1e9, least_bytes = 1e18;
  for (std::size_t n = input.losses.front().patterns; n <= input.losses.back().patterns; ++n) {
    const BlendLoss loss = loss_at(input.losses, static_cast<double>(n));
    for (const CodingCosts* costs : {input.full, input.reduced}) {
      if (costs == nullptr) continue;
      for (int q = kMinQuantiser; q <= kMaxQuantiser; ++q) {
        const double bytes = costs->bytes(n, q);
        const PatternPlan plan{n, q, costs == input.reduced};
        if (bytes < least_bytes) {
          least_bytes = bytes;
          cheapest = plan;
        }
        if (bytes > input.bytes) continue;
        const double error = log_error(loss, costs->squared_error(q));
        if (error < least_error) {
          least_error = error;
          best = plan;
        }
        break;  // coarser ones only have larger errors
      }
    }
  }
  return least_error < 1e9 ? best : cheapest;
}

}  // namespace fbs
