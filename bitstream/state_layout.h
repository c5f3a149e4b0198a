// The state as the motion coder sees it: one row of integers, divided into parts, with limits and neighbours.
// SPEC 5.1.
#pragma once

#include <array>
#include <cstdint>

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs {

/// Part 0 is the pose, part 1 + i is FeatureId i.
inline constexpr int kPartCount = 1 + kFeatureCount;

/// Bit p for part p.
using PartMask = std::uint16_t;

/// Control points of each feature in the order of FeatureId; the same as in generic_head().
inline constexpr std::array<int, kFeatureCount> kControlsOfFeature = {10, 8, 4, 4, 2, 2, 2, 2, 1, 1};

/// All numbers of a state in stream order: the pose, then x and y of each control point.
using FlatState = std::array<std::int32_t, kParameterCount>;

[[nodiscard]] FlatState flatten(const State& state);
[[nodiscard]] State unflatten(const FlatState& flat);

/// What kind of number a parameter is; contexts are shared within a class. 0..5 the pose by PoseIndex, then
/// x and y of outer lips, inner lips, brows, upper lids, lower lids and pupils.
inline constexpr int kClassCount = 6 + 2 * 6;

/// Coarser: 0 the pose, 1 x, 2 y of control points.
inline constexpr int kKindCount = 3;

/// A parameter of this or an earlier part whose residual tells something of this one's; parameter -1: none.
struct Neighbour {
  std::int8_t parameter = -1;
  std::int8_t sign = 1;  ///< -1 where the two move mirrored
};

struct Parameter {
  std::int8_t part = 0;
  std::int8_t kind = 0;      ///< 0..kKindCount-1
  std::int8_t of_class = 0;  ///< 0..kClassCount-1
  Neighbour previous;  ///< control points: same axis, point before in the same feature; pose: number before
  Neighbour across;    ///< y: the same point's x
  Neighbour partner;   ///< right and left: the mirrored point; inner lips: the outer point nearby
};

struct Part {
  std::int8_t first = 0;  ///< parameters [first, first + count)
  std::int8_t count = 0;
  std::int8_t partner = -1;  ///< the part whose change tells something of this one's; coded earlier; -1: none
};

[[nodiscard]] const std::array<Parameter, kParameterCount>& parameters();
[[nodiscard]] const std::array<Part, kPartCount>& parts();

/// What values a scene's states may have, in steps.
struct StateLimits {
  FlatState least{};
  FlatState most{};
  PartMask coded = 1;  ///< the parts that are sent; the others stay zero

  explicit StateLimits(const Setup& setup);

  /// True when every number is within its limits and those of parts not sent are zero.
  [[nodiscard]] bool hold(const FlatState& state) const;
};

}  // namespace fbs
