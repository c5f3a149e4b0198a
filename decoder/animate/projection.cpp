#include "decoder/animate/projection.h"

#include <algorithm>

#include "decoder/animate/fixed_math.h"

namespace fbs {
namespace {

/// The ring lies this much farther from the head's axis than the outline in the seen pose, in 1/256.
constexpr std::int32_t kRingGrowth = 36;

constexpr std::int32_t kRingBehind = kUnitsPerEyeDistance / 2;  // head units

/// Keeps the pupil's vertex between the lids, a quarter of the gap from either: a shutting eye would fold its
/// triangles otherwise.
void keep_between_lids(std::array<glm::ivec3, kVertexCount>& vertices, FeatureId upper_lid,
                       FeatureId lower_lid, FeatureId pupil) {
  const auto y_of = [&](const FeatureVertex& v) { return vertices[v.vertex].y; };
  std::int32_t upper = INT32_MIN, lower = INT32_MAX;
  for (const FeatureVertex& v : feature(upper_lid).vertices) upper = std::max(upper, y_of(v));
  for (const FeatureVertex& v : feature(lower_lid).vertices) lower = std::min(lower, y_of(v));
  std::int32_t& y = vertices[feature(pupil).vertices.front().vertex].y;
  const std::int32_t margin = (lower - upper) / 4;
  y = lower > upper ? std::clamp(y, upper + margin, lower - margin) : upper + (lower - upper) / 2;
}

HeadMesh make_head_mesh() {
  const GenericHead& head = generic_head();
  HeadMesh mesh;
  mesh.triangles.assign(head.triangles.begin(), head.triangles.end());
  const std::size_t n = head.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const std::uint16_t a = head.outline[i], b = head.outline[j];
    const auto ring_a = static_cast<std::uint16_t>(kVertexCount + i);
    const auto ring_b = static_cast<std::uint16_t>(kVertexCount + j);
    mesh.triangles.push_back({a, ring_a, ring_b});
    mesh.triangles.push_back({a, ring_b, b});
  }
  mesh.vertex_count = kVertexCount + static_cast<int>(n);
  return mesh;
}

}  // namespace

std::array<glm::ivec3, kVertexCount> deform(const std::array<glm::ivec3, kVertexCount>& neutral,
                                            const State& state) {
  const GenericHead& head = generic_head();
  std::array<glm::ivec3, kVertexCount> out = neutral;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    std::int64_t x = 0, y = 0;
    for (std::size_t k = head.skinning_begin[v]; k < head.skinning_begin[v + 1]; ++k) {
      const glm::ivec2 c = state.control[head.skinning[k].control];
      x += std::int64_t{head.skinning[k].weight} * c.x;
      y += std::int64_t{head.skinning[k].weight} * c.y;
    }
    out[v].x += static_cast<std::int32_t>(round_shift(x, 12));
    out[v].y += static_cast<std::int32_t>(round_shift(y, 12));
  }
  static_assert(kSkinningOne == 1 << 12);
  keep_between_lids(out, FeatureId::kUpperLidRight, FeatureId::kLowerLidRight, FeatureId::kPupilRight);
  keep_between_lids(out, FeatureId::kUpperLidLeft, FeatureId::kLowerLidLeft, FeatureId::kPupilLeft);
  return out;
}

std::int32_t mouth_shade(std::int32_t gap_now, std::int32_t gap_seen) {
  constexpr std::int32_t kPartedWholly = kUnitsPerEyeDistance / 16;
  static_assert(kPartedWholly == 256);
  return std::clamp(gap_now - gap_seen, 0, kPartedWholly);
}

std::int32_t mouth_gap(const std::array<glm::ivec3, kVertexCount>& vertices) {
  const auto y_of = [&](std::size_t landmark) { return vertices[vertex_of_landmark(landmark)].y; };
  return y_of(66) - y_of(62);
}

bool is_inner_lip(std::size_t vertex) {
  return vertex < kVertexCount && generic_head().vertices[vertex].landmark >= 60;
}

std::int32_t mouth_ramp(std::size_t inner_lip_vertex) {
  const int landmark = generic_head().vertices[inner_lip_vertex].landmark;
  return landmark == 60 || landmark == 64 ? 128 : landmark < 64 ? 0 : 256;
}

const HeadMesh& head_mesh() {
  static const HeadMesh mesh = make_head_mesh();
  return mesh;
}

SceneGeometry::SceneGeometry(const Setup& setup, const Geometry& geometry, SurroundMap map, const State& seen)
    : geometry_(geometry), surround_(setup.format, std::move(map), seen) {
  const HeadProjection projection(head_pose(seen));
  for (const std::uint16_t v : generic_head().outline) {
    const glm::ivec3 p = geometry_.positions[v];
    const glm::ivec3 at = projection({p.x + p.x * kRingGrowth / 256, p.y + p.y * kRingGrowth / 256, p.z});
    ring_.push_back(surround_.place({at.x, at.y}));
  }
}

void SceneGeometry::project_ring(const HeadProjection& projection, ScreenMesh& mesh) const {
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    // Behind the outline, so that the face hides it where the head has moved over it.
    glm::ivec3 p = geometry_.positions[generic_head().outline[i]];
    p.z += kRingBehind;
    mesh.head.emplace_back(surround_.carried(ring_[i], mesh.surround), projection(p).z);
  }
}

void SceneGeometry::light_vertices(const State& state, ScreenMesh& mesh) const {
  const auto& l = state.light;
  if (std::all_of(l.begin(), l.end(), [](std::int32_t v) { return v == 0; })) return;
  // The ring's stay zero: light on the face ends there.
  mesh.light.resize(mesh.head.size());
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::ivec3 p = geometry_.positions[v];
    const std::int64_t x = p.x, y = p.y, v_middle = y - kFaceMiddle;
    const std::int64_t slope = l[kLightSlopeX] * x + l[kLightSlopeY] * y;
    const std::int64_t bow = l[kLightQuadraticXX] * x * x + l[kLightQuadraticYY] * v_middle * v_middle +
                             l[kLightQuadraticXY] * x * v_middle;
    const std::int64_t offset = l[kLightOffset] + round_shift(slope, 12) + round_shift(bow, 24);
    static_assert(kUnitsPerEyeDistance == 1 << 12);
    mesh.light[v] = {static_cast<std::int32_t>(std::clamp<std::int64_t>(offset, -kMaxLight, kMaxLight)),
                     l[kLightGain]};
  }
}

std::array<glm::ivec3, kVertexCount> SceneGeometry::project_vertices(const State& state) const {
  const HeadProjection projection(head_pose(state));
  std::array<glm::ivec3, kVertexCount> points = deform(geometry_.positions, state);
  for (glm::ivec3& p : points) p = projection(p);
  return points;
}

ScreenMesh SceneGeometry::project(const State& state) const {
  const HeadProjection projection(head_pose(state));
  ScreenMesh mesh;
  surround_.project(state, mesh.surround);
  const auto vertices = deform(geometry_.positions, state);
  mesh.mouth_gap = fbs::mouth_gap(vertices);
  mesh.interior = state.interior;
  mesh.head.reserve(static_cast<std::size_t>(head_mesh().vertex_count));
  for (const glm::ivec3& v : vertices) mesh.head.push_back(projection(v));
  project_ring(projection, mesh);
  light_vertices(state, mesh);
  return mesh;
}

}  // namespace fbs
