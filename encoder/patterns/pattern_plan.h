// How many patterns a segment has, at which quantiser and size: what its bytes buy most with.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "encoder/patterns/pattern_trial.h"

namespace fbs {

/// Luma error of a segment's pictures between so many lossless patterns, means over samples.
struct BlendLoss {
  std::size_t patterns;
  double face, frame;
};

/// What patterns of one size cost at several quantisers, rising.
class CodingCosts {
 public:
  /// @param patterns  of the segment, among which the trial's pictures were neighbours
  CodingCosts(std::span<const QuantiserTrial> trials, std::size_t patterns);

  /// Of all patterns.
  [[nodiscard]] double bytes(std::size_t patterns, int quantiser) const;
  /// Luma error of a pattern, mean over samples.
  [[nodiscard]] double squared_error(int quantiser) const;

 private:
  struct Logs {
    double quantiser, first, later, error;
  };
  [[nodiscard]] Logs at(int quantiser) const;

  std::vector<Logs> trials_;
  double patterns_;
};

struct PatternPlan {
  std::size_t patterns;
  int quantiser;  ///< libaom's scale, 0..63
  bool reduced;   ///< half width and height
};

struct PlanInput {
  double bytes = 0;                   ///< that the patterns may take
  std::span<const BlendLoss> losses;  ///< at least one, rising in patterns
  const CodingCosts* full = nullptr;  ///< null: this size is not wanted
  const CodingCosts* reduced = nullptr;
};

/// The plan within the bytes whose predicted face and frame PSNR have the largest mean; where none is, the
/// one with the fewest bytes. Considers numbers of patterns between those of the losses, and all quantisers.
[[nodiscard]] PatternPlan plan_patterns(const PlanInput& input);

}  // namespace fbs
