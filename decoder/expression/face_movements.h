// The movements of the face that have a name in animation programs, as offsets of control points.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "bitstream/syntax.h"
#include "common/generic_head.h"

namespace fbs {

using ControlOffsets = std::array<glm::dvec2, kControlCount>;

/// Independent movements of one part of the face.
enum MouthMovement : std::uint8_t {
  kJawOpen,
  kUpperLipUpRight,
  kUpperLipUpLeft,
  kCornerUpRight,
  kCornerUpLeft,
  kCornerOutRight,
  kCornerOutLeft,
  kMouthLeft,
  kMouthMovements
};
enum BrowMovement : std::uint8_t { kInnerUpRight, kOuterUpRight, kInnerUpLeft, kOuterUpLeft, kBrowMovements };
enum SideMovement : std::uint8_t { kRightSide, kLeftSide, kSideMovements };  ///< of the lids
enum GazeMovement : std::uint8_t { kPupilRightX, kPupilRightY, kPupilLeftX, kPupilLeftY, kGazeMovements };

/// Movements of the parts of GenericHead::expression, in their order; indices are the enumerations'.
[[nodiscard]] std::array<std::vector<ControlOffsets>, kExpressionPartCount> face_movements(
    const Geometry& head);

/// How far a pupil moves from the middle of the eye for each radian that the eye turns, head units: the
/// radius of an eyeball, 12 mm, where the eyes are 63 mm apart.
inline constexpr double kEyeballRadius = 12.0 / 63 * kUnitsPerEyeDistance;

/// Weight of a vertex in the movement of one control point.
[[nodiscard]] double skinning_weight(const WireFrame& head, std::size_t vertex, std::size_t control);

/// A shape with a weight of one, made of movements, and the amounts that make it up.
struct NamedShape {
  std::string_view name;
  std::vector<double> amounts;  ///< for each movement of the part
};
[[nodiscard]] const std::array<std::vector<NamedShape>, kExpressionPartCount>& named_shapes();

/// Weights of the named shapes of a part.
/// @param amounts  for each movement of the part
[[nodiscard]] std::vector<double> shape_weights(std::size_t part, const std::vector<double>& amounts);

}  // namespace fbs
