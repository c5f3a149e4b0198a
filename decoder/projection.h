// State to screen: the head turned, shifted, scaled and deformed, and the surround that goes with it.
// SPEC 8 and 10.1. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs {

inline constexpr int kScreenOneLog2 = 6;             ///< screen positions count 1/64 pixel
inline constexpr std::int32_t kMaxScreen = 1 << 21;  ///< screen positions are clamped to +- this

/// Head pose after dequantisation. x right, y down, z away from the viewer, right-handed;
/// rotation is roll * yaw * pitch, pitch first; projection is weak perspective (scaled orthographic).
struct HeadPose {
  std::int32_t pitch = 0;    ///< about x, 2^-16 turn; positive: the face looks down
  std::int32_t yaw = 0;      ///< about y, 2^-16 turn; positive turns the face to the picture's left
  std::int32_t roll = 0;     ///< about z, 2^-16 turn; positive turns clockwise in the picture
  std::int32_t shift_x = 0;  ///< screen position of the head frame's origin, 1/64 pixel
  std::int32_t shift_y = 0;
  std::int32_t log_scale = 0;  ///< eye distance in pixels is 2^(log_scale / 4096)
  friend bool operator==(const HeadPose&, const HeadPose&) = default;
};

[[nodiscard]] HeadPose dequantise_pose(const State& state, const QuantiserSteps& steps);

/// Linear part of the projection: screen = (matrix * p) * scale + shift.
struct HeadProjection {
  std::array<std::array<std::int32_t, 3>, 3> rotation;  ///< Q14
  std::int64_t scale;                                   ///< pixels per eye distance, Q16
  glm::ivec2 shift;                                     ///< 1/64 pixel

  explicit HeadProjection(const HeadPose& pose);

  /// @param p head units  @return x, y: 1/64 pixel, clamped to +-kMaxScreen; z: head units, larger is farther
  [[nodiscard]] glm::ivec3 operator()(glm::ivec3 p) const;
};

/// Vertices of the head in the head frame after the control points have moved them. Paper section 2.1.
/// @param neutral  the adapted head (Geometry::positions)
[[nodiscard]] std::array<glm::ivec3, kVertexCount> deform(const std::array<glm::ivec3, kVertexCount>& neutral,
                                                          const State& state, const QuantiserSteps& steps);

/// The 105 vertices and the ring round them: one vertex per outline vertex, pushed outwards, that goes with
/// the surround under it. Between the two the jaw can move against the neck without tearing.
struct HeadMesh {
  std::vector<std::array<std::int16_t, 3>> triangles;  ///< clockwise in the picture seen from the front
  int vertex_count = 0;                                ///< kVertexCount + ring
};

/// How much of the mouth's inside hides what the pattern had between the lips: 0 none, 256 all, once the lips
/// have parted by a sixteenth of the eye distance more than in the pattern.
[[nodiscard]] std::int32_t mouth_shade(std::int32_t gap_now, std::int32_t gap_seen);

/// Between the middles of the inner lips of a head as deform() gives it, head units.
[[nodiscard]] std::int32_t mouth_gap(const std::array<glm::ivec3, kVertexCount>& vertices);

/// Whether the vertex lies on the inner lips; a triangle of three such is the inside of the mouth.
[[nodiscard]] bool is_inner_lip(std::int16_t vertex);
/// Upper inner lip 0, corners 128, lower inner lip 256.
[[nodiscard]] std::int32_t mouth_ramp(std::int16_t inner_lip_vertex);

[[nodiscard]] const HeadMesh& head_mesh();

/// Where everything of a scene lies on the screen in one state. Also the texture coordinates of a pattern,
/// for the state in which the pattern was seen.
struct ScreenMesh {
  std::vector<glm::ivec3> head;      ///< head_mesh().vertex_count; as HeadProjection gives
  std::vector<glm::ivec2> surround;  ///< (columns + 1) * (rows + 1), 1/64 pixel; empty without a face
  std::int32_t mouth_gap = 0;        ///< between the middles of the inner lips, head units
};

/// What is fixed for a scene with a face: the adapted head, the surround and how pattern 0 saw them.
class SceneGeometry {
 public:
  /// @param seen  the state of pattern 0, in which the surround's grid is regular
  SceneGeometry(const Setup& setup, const Geometry& geometry, SurroundMap surround, const State& seen);

  [[nodiscard]] ScreenMesh project(const State& state) const;

  /// Screen positions of the 105 vertices alone (1/64 pixel; z in head units).
  [[nodiscard]] std::array<glm::ivec3, kVertexCount> project_vertices(const State& state) const;

  [[nodiscard]] const SurroundMap& surround() const { return surround_; }
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] const QuantiserSteps& steps() const { return steps_; }

 private:
  /// A ring vertex in the seen pose, and the cell of the grid that carries it.
  struct RingVertex {
    glm::ivec2 seen;   ///< 1/64 pixel
    int column, row;   ///< of the cell
    int across, down;  ///< place in the cell, 0..256
  };

  [[nodiscard]] glm::ivec2 regular(int column, int row) const;
  [[nodiscard]] RingVertex place_ring_vertex(glm::ivec2 seen) const;
  void project_surround(const HeadPose& pose, std::vector<glm::ivec2>& out) const;
  void project_ring(const HeadProjection& projection, ScreenMesh& mesh) const;

  QuantiserSteps steps_;
  int width_, height_;
  Geometry geometry_;
  SurroundMap surround_;
  HeadPose seen_;
  std::vector<RingVertex> ring_;
};

}  // namespace fbs
