#include "decoder/expression/face_movements.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace fbs {
namespace {

constexpr double kEye = kUnitsPerEyeDistance;

// Sizes of the movements at a weight of one, head units: about the largest that people make without effort.
constexpr double kJawDrop = 0.6 * kEye;
constexpr double kUpperLipRise = 0.15 * kEye;
constexpr double kCornerReach = 0.15 * kEye;
constexpr double kMouthShift = 0.2 * kEye;
constexpr double kBrowRise = 0.2 * kEye;
const double kGazeReach = kEyeballRadius * std::numbers::pi / 6;

/// How much of a movement a control point takes.
struct Share {
  FeatureId feature;
  std::size_t control;  ///< within its feature
  double amount;
};

/// One displacement applied to several control points.
ControlOffsets moved(glm::dvec2 by, std::initializer_list<Share> shares) {
  ControlOffsets out{};
  for (const Share& s : shares) out[feature(s.feature).first_control + s.control] += s.amount * by;
  return out;
}

constexpr FeatureId kLips = FeatureId::kMouthOuter;

// Control points of the lips begin at the right corner, 0, and go over the upper lip, 1..4, to the left
// corner, 5, and back, 6..9. The inner lips follow the outer ones; their own control points only add to that.
std::vector<ControlOffsets> mouth_movements() {
  std::vector<ControlOffsets> out(kMouthMovements);
  out[kJawOpen] = moved(
      {0, kJawDrop},
      {{kLips, 0, 0.15}, {kLips, 5, 0.15}, {kLips, 6, 0.75}, {kLips, 7, 1}, {kLips, 8, 1}, {kLips, 9, 0.75}});
  out[kUpperLipUpRight] = moved({0, -kUpperLipRise}, {{kLips, 1, 0.8}, {kLips, 2, 1}, {kLips, 3, 0.3}});
  out[kUpperLipUpLeft] = moved({0, -kUpperLipRise}, {{kLips, 4, 0.8}, {kLips, 3, 1}, {kLips, 2, 0.3}});
  const auto right_corner = [](glm::dvec2 by) {
    return moved(by, {{kLips, 0, 1}, {kLips, 1, 0.5}, {kLips, 9, 0.5}});
  };
  const auto left_corner = [](glm::dvec2 by) {
    return moved(by, {{kLips, 5, 1}, {kLips, 4, 0.5}, {kLips, 6, 0.5}});
  };
  out[kCornerUpRight] = right_corner({0, -kCornerReach});
  out[kCornerUpLeft] = left_corner({0, -kCornerReach});
  out[kCornerOutRight] = right_corner({-kCornerReach, 0});
  out[kCornerOutLeft] = left_corner({kCornerReach, 0});
  for (std::size_t i = 0; i < feature(kLips).control_count; ++i)
    out[kMouthLeft][feature(kLips).first_control + i] = {kMouthShift, 0};
  return out;
}

std::vector<ControlOffsets> brow_movements() {
  const glm::dvec2 up{0, -kBrowRise};
  const auto end = [&](FeatureId brow, std::size_t first, std::size_t second) {
    return moved(up, {{brow, first, 1}, {brow, second, 0.8}});
  };
  std::vector<ControlOffsets> out(kBrowMovements);
  out[kInnerUpRight] = end(FeatureId::kBrowRight, 3, 2);
  out[kOuterUpRight] = end(FeatureId::kBrowRight, 0, 1);
  out[kInnerUpLeft] = end(FeatureId::kBrowLeft, 0, 1);
  out[kOuterUpLeft] = end(FeatureId::kBrowLeft, 3, 2);
  return out;
}

double mean_y(const Geometry& head, FeatureId id) {
  double sum = 0;
  const std::span<const FeatureVertex> vertices = head.wire_frame().feature(id).vertices;
  for (const FeatureVertex& v : vertices) sum += head.positions[v.vertex].y;
  return sum / static_cast<double>(vertices.size());
}

/// Moves both control points of a lid so that its vertices move down by `reach`.
ControlOffsets lid_movement(const WireFrame& head, FeatureId lid, double reach) {
  const Feature& f = head.feature(lid);
  double response = 0;
  for (const FeatureVertex& v : f.vertices)
    for (std::size_t c = 0; c < f.control_count; ++c)
      response += skinning_weight(head, v.vertex, f.first_control + c);
  response /= static_cast<double>(f.vertices.size());
  return moved({0, reach / response}, {{lid, 0, 1}, {lid, 1, 1}});
}

/// Opening of an eye; positive even if the lids touch in the adapted head, since they can still move.
double eye_opening(const Geometry& head, FeatureId upper, FeatureId lower) {
  return std::max(mean_y(head, lower) - mean_y(head, upper), 0.05 * kEye);
}

std::vector<ControlOffsets> gaze_movements() {
  std::vector<ControlOffsets> out(kGazeMovements);
  out[kPupilRightX] = moved({kGazeReach, 0}, {{FeatureId::kPupilRight, 0, 1}});
  out[kPupilRightY] = moved({0, kGazeReach}, {{FeatureId::kPupilRight, 0, 1}});
  out[kPupilLeftX] = moved({kGazeReach, 0}, {{FeatureId::kPupilLeft, 0, 1}});
  out[kPupilLeftY] = moved({0, kGazeReach}, {{FeatureId::kPupilLeft, 0, 1}});
  return out;
}

constexpr double kWide = 0.5;  ///< eyeWide raises the lid by this share of what eyeBlink lowers it

double positive(double v) {
  return std::max(v, 0.0);
}

/// A smile pulls the corner up and out at once; the remaining outward movement stretches or puckers.
std::vector<double> mouth_weights(const std::vector<double>& a) {
  const double smile_right = positive(a[kCornerUpRight]), smile_left = positive(a[kCornerUpLeft]);
  const double out_right = a[kCornerOutRight] - smile_right, out_left = a[kCornerOutLeft] - smile_left;
  const double pucker = positive(-std::min(out_right, out_left));
  return {a[kJawOpen],
          a[kUpperLipUpRight],
          a[kUpperLipUpLeft],
          smile_right,
          smile_left,
          positive(-a[kCornerUpRight]),
          positive(-a[kCornerUpLeft]),
          out_right + pucker,
          out_left + pucker,
          pucker,
          positive(-a[kMouthLeft]),
          positive(a[kMouthLeft])};
}

/// The higher end tells how far a brow is down; the remainder raises the ends.
std::vector<double> brow_weights(const std::vector<double>& a) {
  const double down_right = positive(-std::min(a[kInnerUpRight], a[kOuterUpRight]));
  const double down_left = positive(-std::min(a[kInnerUpLeft], a[kOuterUpLeft]));
  const double inner_right = a[kInnerUpRight] + down_right, inner_left = a[kInnerUpLeft] + down_left;
  return {(inner_right + inner_left) / 2,
          (inner_left - inner_right) / 2,
          a[kOuterUpRight] + down_right,
          a[kOuterUpLeft] + down_left,
          down_right,
          down_left};
}

std::vector<double> upper_lid_weights(const std::vector<double>& a) {
  return {positive(a[kRightSide]), positive(a[kLeftSide]), positive(-a[kRightSide]) / kWide,
          positive(-a[kLeftSide]) / kWide};
}

std::vector<double> gaze_weights(const std::vector<double>& a) {
  std::vector<double> out;
  for (const double v : a) {
    out.push_back(positive(v));
    out.push_back(positive(-v));
  }
  return out;
}

/// @param amounts  pairs of movement and amount
NamedShape shape(std::string_view name, std::size_t movements,
                 std::initializer_list<std::pair<std::size_t, double>> amounts) {
  NamedShape out{name, std::vector<double>(movements)};
  for (const auto& [movement, amount] : amounts) out.amounts[movement] = amount;
  return out;
}

std::vector<NamedShape> mouth_shapes() {
  const auto of = [](std::string_view name, std::initializer_list<std::pair<std::size_t, double>> amounts) {
    return shape(name, kMouthMovements, amounts);
  };
  return {of("jawOpen", {{kJawOpen, 1}}),
          of("mouthUpperUpRight", {{kUpperLipUpRight, 1}}),
          of("mouthUpperUpLeft", {{kUpperLipUpLeft, 1}}),
          of("mouthSmileRight", {{kCornerUpRight, 1}, {kCornerOutRight, 1}}),
          of("mouthSmileLeft", {{kCornerUpLeft, 1}, {kCornerOutLeft, 1}}),
          of("mouthFrownRight", {{kCornerUpRight, -1}}),
          of("mouthFrownLeft", {{kCornerUpLeft, -1}}),
          of("mouthStretchRight", {{kCornerOutRight, 1}}),
          of("mouthStretchLeft", {{kCornerOutLeft, 1}}),
          of("mouthPucker", {{kCornerOutRight, -1}, {kCornerOutLeft, -1}}),
          of("mouthRight", {{kMouthLeft, -1}}),
          of("mouthLeft", {{kMouthLeft, 1}})};
}

std::vector<NamedShape> brow_shapes() {
  const auto of = [](std::string_view name, std::initializer_list<std::pair<std::size_t, double>> amounts) {
    return shape(name, kBrowMovements, amounts);
  };
  return {of("browInnerUp", {{kInnerUpRight, 1}, {kInnerUpLeft, 1}}),
          of("browInnerUpAsymmetry", {{kInnerUpRight, -1}, {kInnerUpLeft, 1}}),
          of("browOuterUpRight", {{kOuterUpRight, 1}}),
          of("browOuterUpLeft", {{kOuterUpLeft, 1}}),
          of("browDownRight", {{kInnerUpRight, -1}, {kOuterUpRight, -1}}),
          of("browDownLeft", {{kInnerUpLeft, -1}, {kOuterUpLeft, -1}})};
}

std::vector<NamedShape> gaze_shapes() {
  const auto of = [](std::string_view name, GazeMovement movement, double amount) {
    return shape(name, kGazeMovements, {{movement, amount}});
  };
  return {of("eyeLookInRight", kPupilRightX, 1),   of("eyeLookOutRight", kPupilRightX, -1),
          of("eyeLookDownRight", kPupilRightY, 1), of("eyeLookUpRight", kPupilRightY, -1),
          of("eyeLookOutLeft", kPupilLeftX, 1),    of("eyeLookInLeft", kPupilLeftX, -1),
          of("eyeLookDownLeft", kPupilLeftY, 1),   of("eyeLookUpLeft", kPupilLeftY, -1)};
}

}  // namespace

double skinning_weight(const WireFrame& head, std::size_t vertex, std::size_t control) {
  for (const SkinningWeight& s : head.skinning_of(vertex))
    if (s.control == control) return s.weight / static_cast<double>(kSkinningOne);
  return 0;
}

std::array<std::vector<ControlOffsets>, kExpressionPartCount> face_movements(const Geometry& head) {
  const double right = eye_opening(head, FeatureId::kUpperLidRight, FeatureId::kLowerLidRight);
  const double left = eye_opening(head, FeatureId::kUpperLidLeft, FeatureId::kLowerLidLeft);
  return {mouth_movements(),
          brow_movements(),
          {lid_movement(head.wire_frame(), FeatureId::kUpperLidRight, right),
           lid_movement(head.wire_frame(), FeatureId::kUpperLidLeft, left)},
          {lid_movement(head.wire_frame(), FeatureId::kLowerLidRight, -right / 2),
           lid_movement(head.wire_frame(), FeatureId::kLowerLidLeft, -left / 2)},
          gaze_movements()};
}

const std::array<std::vector<NamedShape>, kExpressionPartCount>& named_shapes() {
  static const std::array<std::vector<NamedShape>, kExpressionPartCount> all = {
      mouth_shapes(), brow_shapes(),
      std::vector<NamedShape>{shape("eyeBlinkRight", kSideMovements, {{kRightSide, 1}}),
                              shape("eyeBlinkLeft", kSideMovements, {{kLeftSide, 1}}),
                              shape("eyeWideRight", kSideMovements, {{kRightSide, -kWide}}),
                              shape("eyeWideLeft", kSideMovements, {{kLeftSide, -kWide}})},
      std::vector<NamedShape>{shape("eyeSquintRight", kSideMovements, {{kRightSide, 1}}),
                              shape("eyeSquintLeft", kSideMovements, {{kLeftSide, 1}})},
      gaze_shapes()};
  return all;
}

std::vector<double> shape_weights(std::size_t part, const std::vector<double>& amounts) {
  switch (part) {
    case 0:
      return mouth_weights(amounts);
    case 1:
      return brow_weights(amounts);
    case 2:
      return upper_lid_weights(amounts);
    case 3:
      return amounts;
    default:
      return gaze_weights(amounts);
  }
}

}  // namespace fbs
