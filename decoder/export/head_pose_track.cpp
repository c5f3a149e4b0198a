#include "decoder/export/head_pose_track.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "decoder/head/head_deformation.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

constexpr double kUnit = 1.0 / kUnitsPerEyeDistance;  ///< head unit, in eye distances
constexpr double kPupilStep = 0.1;                    ///< pupilRightDown at a weight of one, eye distances

double radians(std::int32_t turn_2_16) {
  return turn_2_16 * (2 * std::numbers::pi / 65536);
}

double size_of(const MorphTarget& target) {
  double largest = 0;
  for (const glm::dvec3& d : target.displacements)
    largest = std::max({largest, std::abs(d.x), std::abs(d.y)});
  return largest;
}

}  // namespace

ModelPose model_pose(const State& state) {
  const HeadPose pose = head_pose(state);
  // Half a turn of the axes about x reverses turns about y and z.
  const glm::dquat pitch = glm::angleAxis(radians(pose.pitch), glm::dvec3(1, 0, 0));
  const glm::dquat yaw = glm::angleAxis(-radians(pose.yaw), glm::dvec3(0, 1, 0));
  const glm::dquat roll = glm::angleAxis(-radians(pose.roll), glm::dvec3(0, 0, 1));
  const double pixel = 1 << kScreenOneLog2;
  return {roll * yaw * pitch, to_model_axes({pose.shift_x / pixel, pose.shift_y / pixel, 0}),
          std::exp2(pose.log_scale / 4096.0)};
}

std::vector<glm::dvec3> model_vertices(const Geometry& geometry) {
  std::vector<glm::dvec3> out;
  for (const glm::ivec3& p : geometry.positions) out.push_back(kUnit * to_model_axes(p));
  return out;
}

std::vector<glm::vec3> vertex_normals(const std::vector<glm::dvec3>& vertices,
                                      std::span<const std::uint16_t> corners) {
  std::vector<glm::dvec3> sums(vertices.size());
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    const glm::dvec3 a = vertices[corners[t]], b = vertices[corners[t + 1]], c = vertices[corners[t + 2]];
    for (std::size_t k = 0; k < 3; ++k) sums[corners[t + k]] += glm::cross(b - a, c - a);
  }
  std::vector<glm::vec3> out;
  out.reserve(sums.size());
  for (const glm::dvec3& s : sums)
    out.emplace_back(glm::length(s) > 1e-9 ? glm::normalize(s) : glm::dvec3(0, 0, 1));
  return out;
}

HeadMorphs::HeadMorphs(const Geometry& geometry) : geometry_(geometry), expression_(geometry) {
  for (const ExpressionTarget& shape : expression_.targets()) {
    MorphTarget target{shape.name, {}};
    for (std::size_t v = 0; v < geometry.positions.size(); ++v)
      target.displacements.push_back(
          kUnit * to_model_axes(glm::dvec3(displacement(shape, geometry.wire_frame(), v), 0)));
    targets_.push_back(std::move(target));
  }
  constexpr std::array kNames{"pupilRightDown", "pupilLeftDown"};
  for (std::size_t side = 0; side < kNames.size(); ++side) {
    MorphTarget target{kNames[side], std::vector<glm::dvec3>(geometry.positions.size())};
    target.displacements[geometry.wire_frame().pupil_vertices()[side]] = to_model_axes({0, kPupilStep, 0});
    targets_.push_back(std::move(target));
  }
}

std::vector<double> HeadMorphs::weights(const State& state) const {
  std::vector<double> out = expression_.weights(state);
  const auto deformed = deform(geometry_, state);
  for (const std::size_t v : geometry_.wire_frame().pupil_vertices()) {
    double linear = geometry_.positions[v].y;
    for (const SkinningWeight& s : geometry_.wire_frame().skinning_of(v))
      linear += s.weight * state.control[s.control].y / static_cast<double>(kSkinningOne);
    const double more = deformed[v].y - linear;
    out.push_back(std::abs(more) <= 1 ? 0 : more * kUnit / kPupilStep);
  }
  return out;
}

std::vector<double> HeadMorphs::tolerances() const {
  std::vector<double> out;
  for (const MorphTarget& t : targets_) out.push_back(kUnit / std::max(size_of(t), kUnit));
  return out;
}

}  // namespace fbs
