// State to screen: the head turned, shifted, scaled and deformed, lit, and the surround round it. SPEC 8
// and 10.1. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "common/state.h"
#include "decoder/animate/head_projection.h"
#include "decoder/animate/surround.h"

namespace fbs {

/// Vertices of the head in the head frame after the control points have moved them. Paper section 2.1.
/// @param neutral  the adapted head (Geometry::positions)
[[nodiscard]] std::array<glm::ivec3, kVertexCount> deform(const std::array<glm::ivec3, kVertexCount>& neutral,
                                                          const State& state);

/// The 105 vertices and the ring round them: one vertex per outline vertex, pushed outwards, that goes with
/// the surround under it. Between the two the jaw can move against the neck without tearing.
struct HeadMesh {
  std::vector<HeadTriangle> triangles;  ///< clockwise in the picture seen from the front
  int vertex_count = 0;                 ///< kVertexCount + ring
};

/// How much of the mouth's inside hides what the pattern had between the lips: 0 none, 256 all, once the lips
/// have parted by a sixteenth of the eye distance more than in the pattern.
[[nodiscard]] std::int32_t mouth_shade(std::int32_t gap_now, std::int32_t gap_seen);

/// Between the middles of the inner lips of a head as deform() gives it, head units.
[[nodiscard]] std::int32_t mouth_gap(const std::array<glm::ivec3, kVertexCount>& vertices);

/// Whether the vertex lies on the inner lips; a triangle of three such is the inside of the mouth.
[[nodiscard]] bool is_inner_lip(std::size_t vertex);
/// Upper inner lip 0, corners 128, lower inner lip 256.
[[nodiscard]] std::int32_t mouth_ramp(std::size_t inner_lip_vertex);

[[nodiscard]] const HeadMesh& head_mesh();

/// What the light adds to luma at a vertex, 1/16 grey level: always, and to luma 64 levels brighter than 128.
struct VertexLight {
  std::int32_t offset = 0, gain = 0;
};

/// Where everything of a scene lies on the screen in one state. Also the texture coordinates of a pattern,
/// for the state in which the pattern was seen.
struct ScreenMesh {
  std::vector<glm::ivec3> head;                         ///< head_mesh().vertex_count; as HeadProjection gives
  std::vector<glm::ivec2> surround;                     ///< as Surround::project gives; empty without a face
  std::int32_t mouth_gap = 0;                           ///< between the middles of the inner lips, head units
  std::array<std::int32_t, kInteriorCount> interior{};  ///< as State::interior
  std::vector<VertexLight> light;                       ///< of each vertex of the head; empty: none has any
};

/// What is fixed for a scene with a face: the adapted head, the surround and how pattern 0 saw them.
class SceneGeometry {
 public:
  /// @param seen  the state of pattern 0, in which the surround's grid is regular
  SceneGeometry(const Setup& setup, const Geometry& geometry, SurroundMap surround, const State& seen);

  [[nodiscard]] ScreenMesh project(const State& state) const;

  /// Screen positions of the 105 vertices alone (1/64 pixel; z in head units).
  [[nodiscard]] std::array<glm::ivec3, kVertexCount> project_vertices(const State& state) const;

  [[nodiscard]] const Surround& surround() const { return surround_; }
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }

 private:
  void project_ring(const HeadProjection& projection, ScreenMesh& mesh) const;
  void light_vertices(const State& state, ScreenMesh& mesh) const;

  Geometry geometry_;
  Surround surround_;
  std::vector<Surround::Place> ring_;
};

}  // namespace fbs
