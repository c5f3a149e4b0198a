#include "decoder/expression/state_edit.h"

#include <algorithm>
#include <span>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

constexpr std::int32_t degrees(int d) {
  return d * 65536 / 360;
}

// By EditPart.
constexpr std::array<StateEdit::Limits, kEditPartCount> kLimits = {{
    {-degrees(18), degrees(18), degrees(3)},
    {-degrees(12), degrees(12), degrees(2)},
    {-degrees(15), degrees(15), degrees(3)},
    {-400, 560, 80},
    {-800, 1600, 200},
    {-280, 560, 70},
    {-kSkinningOne / 4, kSkinningOne, kSkinningOne / 4},
}};

/// How far a control point follows a part's edit, in 1/100.
struct ControlShift {
  std::uint8_t control;  ///< within its feature
  std::int8_t x, y;
};

// Inner lips ride on the outer ones: a movement of both is given for the outer ones alone, and the lips keep
// their thickness. Most of an opening is the jaw's. Set by eye.
constexpr std::array kOuterOpening = {
    ControlShift{0, 12, 30}, ControlShift{1, 4, -2},   ControlShift{2, 0, -14}, ControlShift{3, 0, -14},
    ControlShift{4, -4, -2}, ControlShift{5, -12, 30}, ControlShift{6, 0, 84},  ControlShift{7, 0, 90},
    ControlShift{8, 0, 90},  ControlShift{9, 0, 84}};
constexpr std::array kInnerOpening = {ControlShift{5, 16, 6}, ControlShift{7, -16, 6}};
constexpr std::array kOuterSmile = {ControlShift{0, -100, -70}, ControlShift{1, -50, -28},
                                    ControlShift{4, 50, -28},   ControlShift{5, 100, -70},
                                    ControlShift{6, 50, -28},   ControlShift{9, -50, -28}};
constexpr std::array kBrow = {ControlShift{0, 0, -100}, ControlShift{1, 0, -100}, ControlShift{2, 0, -100},
                              ControlShift{3, 0, -100}};

void move(State& state, FeatureId id, std::span<const ControlShift> shares, std::int32_t offset) {
  const std::size_t first = feature(id).first_control;
  for (const ControlShift& s : shares)
    state.control[first + s.control] += glm::ivec2(s.x, s.y) * offset / 100;
}

void move_mouth(State& state, const Geometry& head, std::int32_t wanted) {
  // The state's own gap is left alone, however wide.
  const std::int32_t gap = mouth_gap(head, state);
  const std::int32_t highest = std::max(0, kLimits[static_cast<std::size_t>(EditPart::kMouth)].high - gap);
  const std::int32_t lowest = -std::max(0, gap);
  const std::int32_t offset = std::clamp(wanted, lowest, highest);
  move(state, FeatureId::kMouthInner, kInnerOpening, offset);
  move(state, FeatureId::kMouthOuter, kOuterOpening, offset);
}

/// Sum of the weights of the controls at a vertex.
std::int32_t weight_sum(const WireFrame& head, std::size_t vertex) {
  std::int32_t sum = 0;
  for (const SkinningWeight& s : head.skinning_of(vertex)) sum += s.weight;
  return std::max(sum, 1);
}

struct Eye {
  FeatureId upper, lower;
  std::array<std::uint8_t, 2> upper_marks, lower_marks;  ///< iBUG-68; index k of both lie above one another
};
constexpr std::array kEyes = {Eye{FeatureId::kUpperLidRight, FeatureId::kLowerLidRight, {37, 38}, {41, 40}},
                              Eye{FeatureId::kUpperLidLeft, FeatureId::kLowerLidLeft, {43, 44}, {47, 46}}};

/// @param share  in 1/kSkinningOne
void shut(State& state, const Eye& eye, const Geometry& head, std::int32_t share) {
  constexpr std::int64_t kUpperPart = 85;  // percent of the way that the upper lid goes
  const auto vertices = deform(head, state);
  const auto y = [&](std::uint8_t mark) { return vertices[head.wire_frame().vertex_of_landmark(mark)].y; };
  // Both controls of a lid move by the smaller gap, so that the lids meet there and do not cross.
  const std::int64_t gap = std::max(0, std::min(y(eye.lower_marks[0]) - y(eye.upper_marks[0]),
                                                y(eye.lower_marks[1]) - y(eye.upper_marks[1])));
  const auto move_lid = [&](FeatureId id, std::uint8_t mark, std::int64_t percent) {
    const std::int64_t weight = weight_sum(head.wire_frame(), head.wire_frame().vertex_of_landmark(mark));
    const auto offset = static_cast<std::int32_t>(gap * share * percent / 100 / weight);
    const Feature& lid = feature(id);
    for (std::size_t c = 0; c < lid.control_count; ++c) state.control[lid.first_control + c].y += offset;
  };
  move_lid(eye.upper, eye.upper_marks[0], kUpperPart);
  move_lid(eye.lower, eye.lower_marks[0], kUpperPart - 100);
}

void keep_within_limits(State& state) {
  for (const int angle : {kPitch, kYaw, kRoll})
    state.pose[angle] = std::clamp(state.pose[angle], -kMaxRotation, kMaxRotation);
  for (glm::ivec2& c : state.control)
    c = {std::clamp(c.x, -kMaxControl, kMaxControl), std::clamp(c.y, -kMaxControl, kMaxControl)};
}

}  // namespace

const StateEdit::Limits& StateEdit::limits(EditPart part) {
  return kLimits[static_cast<std::size_t>(part)];
}

void StateEdit::add(EditPart part, std::int32_t offset) {
  std::int32_t& value = values_[static_cast<std::size_t>(part)];
  value = std::clamp(value + offset, limits(part).low, limits(part).high);
}

void set_in_motion(State& state) {
  for (const Region r : {Region::kMouth, Region::kRightEye, Region::kLeftEye, Region::kFace, Region::kHair}) {
    BlendMode& mode = state.blend[static_cast<std::size_t>(r)];
    if (mode == BlendMode::kHalfStill || mode == BlendMode::kStillBefore || mode == BlendMode::kStillAfter)
      mode = BlendMode::kByState;
  }
}

State StateEdit::applied(const State& state, const Geometry& head) const {
  if (!any()) return state;
  State out = state;
  out.pose[kYaw] += value(EditPart::kYaw);
  out.pose[kPitch] += value(EditPart::kPitch);
  out.pose[kRoll] += value(EditPart::kRoll);
  for (const FeatureId brow : {FeatureId::kBrowRight, FeatureId::kBrowLeft})
    move(out, brow, kBrow, value(EditPart::kBrows));
  if (value(EditPart::kMouth) != 0) move_mouth(out, head, value(EditPart::kMouth));
  move(out, FeatureId::kMouthOuter, kOuterSmile, value(EditPart::kSmile));
  for (const Eye& eye : kEyes) shut(out, eye, head, value(EditPart::kLids));
  keep_within_limits(out);
  set_in_motion(out);
  return out;
}

}  // namespace fbs
