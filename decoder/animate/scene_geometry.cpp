#include "decoder/animate/scene_geometry.h"

#include <algorithm>
#include <utility>

#include "bitstream/payload/geometry_payload.h"
#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

/// In the rest pose the ring lies this much farther from the head's axis than the outline, in 1/256: room for
/// the jaw to move in, small enough to stay on the neck. Set by eye on the ten clips.
constexpr std::int32_t kRingExtension = 36;
constexpr std::int32_t kRingExtensionOne = 256;

/// The ring lies this much deeper than the outline, head units, so that the face hides it where the head has
/// moved over it.
constexpr std::int32_t kRingDepth = kUnitsPerEyeDistance / 2;

/// ScreenMesh::areas. The ring does not count: it folds wherever the head moves over it, which hides nothing.
std::vector<std::int64_t> vertex_areas(const WireFrame& head, const std::vector<glm::ivec3>& screen) {
  std::vector<std::int64_t> out(screen.size());
  for (const HeadTriangle& t : head.triangles) {
    const std::int64_t ax = screen[t[1]].x - screen[t[0]].x, ay = screen[t[1]].y - screen[t[0]].y,
                       bx = screen[t[2]].x - screen[t[0]].x, by = screen[t[2]].y - screen[t[0]].y;
    const std::int64_t area = ax * by - ay * bx;
    if (area > 0)
      for (const std::uint16_t v : t) out[v] += area;
  }
  return out;
}

}  // namespace

SceneGeometry::SceneGeometry(const Setup& setup, const Geometry& geometry, SurroundMap map, const State& rest)
    : geometry_(geometry),
      surround_(setup.format, std::move(map), rest),
      is_plane_(is_flat(geometry)),
      surround_triangles_(surround_.triangles()) {
  const HeadProjection projection(head_pose(rest));
  rest_scale_ = projection.scale;
  const WireFrame& head = geometry_.wire_frame();
  if (geometry_.own_frame) own_mesh_ = std::make_shared<const HeadMesh>(head);
  if (geometry_.own_frame && !is_plane_)
    own_layout_ = std::make_shared<const AtlasLayout>(head, atlas_eye_distance(rest_scale_));
  for (const std::uint16_t v : head.outline) {
    glm::ivec3 p = geometry_.positions[v];
    p.x += p.x * kRingExtension / kRingExtensionOne;
    p.y += p.y * kRingExtension / kRingExtensionOne;
    const glm::ivec3 at = projection(p);
    ring_.push_back(surround_.place({at.x, at.y}));
  }
  head_shares_ = vertex_shares(head);
  for (const Surround::Place& place : ring_) head_shares_.push_back(surround_.shares_at(place));
  if (is_plane_) {
    const auto first = static_cast<std::int32_t>(surround_.point_count());
    for (const HeadTriangle& t : head_mesh().triangles)
      surround_triangles_.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void SceneGeometry::project_ring(const HeadProjection& projection, ScreenMesh& mesh) const {
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    glm::ivec3 p = geometry_.positions[geometry_.wire_frame().outline[i]];
    p.z += kRingDepth;
    mesh.head.emplace_back(surround_.carried(ring_[i], mesh.surround), projection(p).z);
  }
}

ScreenMesh SceneGeometry::screen_mesh(const State& state) const {
  const HeadProjection projection(head_pose(state));
  ScreenMesh mesh;
  surround_.project(state, mesh.surround);
  const auto vertices = deform(geometry_, state);
  mesh.head.reserve(head_mesh().vertex_count);
  for (const glm::ivec3& v : vertices) mesh.head.push_back(projection(v));
  project_ring(projection, mesh);
  if (is_plane_)
    for (const glm::ivec3& v : mesh.head) mesh.surround.emplace_back(v.x, v.y);
  mesh.areas = vertex_areas(geometry_.wire_frame(), mesh.head);
  mesh.light = vertex_lights(geometry_.positions, ring_.size(), state.light);
  mesh.mouth_gap = mouth_gap(geometry_.wire_frame(), vertices);
  mesh.interior = state.interior;
  return mesh;
}

TextureMesh SceneGeometry::texture_mesh(const State& seen) const {
  ScreenMesh mesh = screen_mesh(seen);
  TextureMesh texture;
  texture.head.reserve(mesh.head.size());
  for (const glm::ivec3& v : mesh.head) texture.head.emplace_back(v.x, v.y);
  texture.light = std::move(mesh.light);
  texture.mouth_gap = mesh.mouth_gap;
  texture.areas = std::move(mesh.areas);
  texture.surround = std::move(mesh.surround);
  return texture;
}

std::vector<glm::ivec3> SceneGeometry::project_vertices(const State& state) const {
  return fbs::project_vertices(geometry_, state);
}

}  // namespace fbs
