#include "library/face_data.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

constexpr float kDegreesPerUnit = 360.0F / 65536;
constexpr float kPixelsPerUnit = 1.0F / (1 << kScreenOneLog2);
constexpr float kEyeDistancesPerUnit = 1.0F / kUnitsPerEyeDistance;
constexpr double kOctavesPerUnit = 1.0 / 4096;

using Vertices = std::vector<glm::ivec3>;

/// Areas of the triangles at each vertex, facing the viewer and facing away. Areas of parallelograms, 1/64
/// pixel squared: only the ratio matters.
struct VertexAreas {
  std::vector<double> seen, hidden;
};

VertexAreas areas_of(const WireFrame& head, const Vertices& vertices) {
  VertexAreas out{std::vector<double>(vertices.size()), std::vector<double>(vertices.size())};
  for (const HeadTriangle& t : head.triangles) {
    const glm::ivec3 a = vertices[t[1]] - vertices[t[0]], b = vertices[t[2]] - vertices[t[0]];
    const std::int64_t area = std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
    auto& side = area > 0 ? out.seen : out.hidden;
    for (const std::uint16_t v : t) side[v] += std::abs(static_cast<double>(area));
  }
  return out;
}

/// The integer nearest to `value / unit`, if it is within -limit..limit.
std::optional<std::int32_t> in_units(double value, double unit, std::int32_t limit) {
  const double units = std::round(value / unit);
  if (!(std::abs(units) <= limit)) return std::nullopt;  // false for NaN, too
  return static_cast<std::int32_t>(units);
}

/// Maps -1 and 1 to the limits of a part.
std::int32_t share_of(EditPart part, float share) {
  const StateEdit::Limits& limits = StateEdit::limits(part);
  const double clamped = std::clamp(share, -1.0F, 1.0F);
  return static_cast<std::int32_t>(std::lround(clamped < 0 ? -clamped * limits.low : clamped * limits.high));
}

std::int32_t angle_of(EditPart part, float degrees) {
  const StateEdit::Limits& limits = StateEdit::limits(part);
  const double units = static_cast<double>(degrees) / kDegreesPerUnit;
  return static_cast<std::int32_t>(std::lround(std::clamp<double>(units, limits.low, limits.high)));
}

}  // namespace

fbs_face_state face_state(const State& state) {
  const HeadPose pose = head_pose(state);
  fbs_face_state out{};
  out.pitch = static_cast<float>(pose.pitch) * kDegreesPerUnit;
  out.yaw = static_cast<float>(pose.yaw) * kDegreesPerUnit;
  out.roll = static_cast<float>(pose.roll) * kDegreesPerUnit;
  out.x = static_cast<float>(pose.shift_x) * kPixelsPerUnit;
  out.y = static_cast<float>(pose.shift_y) * kPixelsPerUnit;
  out.eye_distance = static_cast<float>(std::exp2(pose.log_scale * kOctavesPerUnit));
  for (std::size_t c = 0; c < kControlCount; ++c) {
    out.control[c][0] = static_cast<float>(state.control[c].x) * kEyeDistancesPerUnit;
    out.control[c][1] = static_cast<float>(state.control[c].y) * kEyeDistancesPerUnit;
  }
  return out;
}

std::optional<State> state_of(const fbs_face_state& face, const State& sent) {
  State out = sent;
  const auto set = [](std::int32_t& place, double value, double unit, std::int32_t limit) {
    const auto units = in_units(value, unit, limit);
    if (units) place = *units;
    return units.has_value();
  };
  bool valid = set(out.pose[kPitch], face.pitch, kDegreesPerUnit, kMaxRotation) &&
               set(out.pose[kYaw], face.yaw, kDegreesPerUnit, kMaxRotation) &&
               set(out.pose[kRoll], face.roll, kDegreesPerUnit, kMaxRotation) &&
               set(out.pose[kShiftX], face.x, kPixelsPerUnit, kMaxTranslation) &&
               set(out.pose[kShiftY], face.y, kPixelsPerUnit, kMaxTranslation) && face.eye_distance >= 1 &&
               set(out.pose[kLogScale], std::log2(face.eye_distance), kOctavesPerUnit, kMaxLogScale);
  for (std::size_t c = 0; c < kControlCount; ++c)
    valid = valid && set(out.control[c].x, face.control[c][0], kEyeDistancesPerUnit, kMaxControl) &&
            set(out.control[c].y, face.control[c][1], kEyeDistancesPerUnit, kMaxControl);
  if (!valid) return std::nullopt;
  if (out != sent) set_in_motion(out);
  return out;
}

std::optional<StateEdit> edit_of(const fbs_face_edit& edit) {
  for (const float v : {edit.pitch, edit.yaw, edit.roll, edit.brows, edit.mouth, edit.smile, edit.lids})
    if (std::isnan(v)) return std::nullopt;
  StateEdit out;
  out.add(EditPart::kPitch, angle_of(EditPart::kPitch, edit.pitch));
  out.add(EditPart::kYaw, angle_of(EditPart::kYaw, edit.yaw));
  out.add(EditPart::kRoll, angle_of(EditPart::kRoll, edit.roll));
  out.add(EditPart::kBrows, share_of(EditPart::kBrows, edit.brows));
  out.add(EditPart::kMouth, share_of(EditPart::kMouth, edit.mouth));
  out.add(EditPart::kSmile, share_of(EditPart::kSmile, edit.smile));
  out.add(EditPart::kLids, share_of(EditPart::kLids, edit.lids));
  return out;
}

void write_vertices(const SceneGeometry& face, const State& state, std::span<fbs_vertex> out) {
  const Vertices vertices = face.project_vertices(state);
  for (std::size_t v = 0; v < out.size(); ++v)
    out[v] = {static_cast<float>(vertices[v].x) * kPixelsPerUnit,
              static_cast<float>(vertices[v].y) * kPixelsPerUnit,
              static_cast<float>(vertices[v].z) * kEyeDistancesPerUnit};
}

void write_landmarks(const SceneGeometry& face, const State& state,
                     std::span<fbs_landmark, kLandmarkCount> out) {
  const WireFrame& head = face.geometry().wire_frame();
  const Vertices vertices = face.project_vertices(state);
  const VertexAreas areas = areas_of(head, vertices);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::size_t v = head.vertex_of_landmark(k);
    const double all = areas.seen[v] + areas.hidden[v];
    out[k] = {static_cast<float>(vertices[v].x) * kPixelsPerUnit,
              static_cast<float>(vertices[v].y) * kPixelsPerUnit,
              all > 0 ? static_cast<float>(areas.seen[v] / all) : 0};
  }
}

}  // namespace fbs
