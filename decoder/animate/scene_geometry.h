// State to screen: adapted head and surround of a scene in any state. SPEC 8 and 10.1. Integers only.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "bitstream/syntax.h"
#include "common/state.h"
#include "decoder/animate/screen_mesh.h"
#include "decoder/animate/surround.h"
#include "decoder/atlas/atlas_layout.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/head_projection.h"

namespace fbs {

/// The fixed part of a scene with a face: adapted head and surround.
class SceneGeometry {
 public:
  /// @param rest  the rest state, in which the surround's grid is regular: the first pattern's
  SceneGeometry(const Setup& setup, const Geometry& geometry, SurroundMap map, const State& rest);

  /// Screen positions of the mesh in `state`.
  [[nodiscard]] ScreenMesh screen_mesh(const State& state) const;

  /// Positions of the mesh in a pattern seen in `seen`, any state of the scene.
  [[nodiscard]] TextureMesh texture_mesh(const State& seen) const;

  /// Screen positions of the vertices of the wire-frame alone (1/64 pixel; z in head units).
  [[nodiscard]] std::vector<glm::ivec3> project_vertices(const State& state) const;

  /// Shares of the regions at each vertex of head_mesh().
  [[nodiscard]] const std::vector<RegionShares>& head_shares() const { return head_shares_; }

  [[nodiscard]] const HeadMesh& head_mesh() const { return own_mesh_ ? *own_mesh_ : generic_head_mesh(); }

  /// Layout of the head's atlas; not if the head is a plane.
  [[nodiscard]] const AtlasLayout& atlas_layout() const {
    return own_layout_ ? *own_layout_ : generic_atlas_layout(rest_scale_);
  }

  /// Whether the head is flat: a plane that moves the picture, not a face. It is not drawn; its vertices are
  /// points of the surround, after the grid's.
  [[nodiscard]] bool is_plane() const { return is_plane_; }

  /// Triangles of the surround in drawing order: halves of the cells, then the head's if it is a plane.
  [[nodiscard]] const std::vector<MeshTriangle>& surround_triangles() const { return surround_triangles_; }

  /// Samples per eye distance in the rest state, Q16.
  [[nodiscard]] std::int64_t rest_scale() const { return rest_scale_; }

  [[nodiscard]] const Surround& surround() const { return surround_; }
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }

 private:
  void project_ring(const HeadProjection& projection, ScreenMesh& mesh) const;

  Geometry geometry_;
  Surround surround_;
  std::vector<Surround::Place> ring_;
  std::vector<RegionShares> head_shares_;
  bool is_plane_;
  std::vector<MeshTriangle> surround_triangles_;
  std::int64_t rest_scale_;
  std::shared_ptr<const HeadMesh> own_mesh_;       ///< null: the generic head's
  std::shared_ptr<const AtlasLayout> own_layout_;  ///< null: the generic head's
};

}  // namespace fbs
