// State to screen: adapted head and surround of a scene in any state. SPEC 8 and 10.1. Integers only.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "common/state.h"
#include "decoder/animate/screen_mesh.h"
#include "decoder/animate/surround.h"
#include "decoder/head/head_projection.h"

namespace fbs {

/// What is fixed for a scene with a face: the adapted head and the surround.
class SceneGeometry {
 public:
  /// @param rest  the rest state: the surround's grid is regular in it. The first pattern's.
  SceneGeometry(const Setup& setup, const Geometry& geometry, SurroundMap map, const State& rest);

  /// Where everything is drawn in `state`.
  [[nodiscard]] ScreenMesh screen_mesh(const State& state) const;

  /// Where a pattern seen in `seen`, any state of the scene, holds what is drawn.
  [[nodiscard]] TextureMesh texture_mesh(const State& seen) const;

  /// Screen positions of the 105 vertices alone (1/64 pixel; z in head units).
  [[nodiscard]] std::array<glm::ivec3, kVertexCount> project_vertices(const State& state) const;

  /// Shares of the regions at each vertex of head_mesh().
  [[nodiscard]] const std::vector<RegionShares>& head_shares() const { return head_shares_; }

  [[nodiscard]] const Surround& surround() const { return surround_; }
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }

 private:
  void project_ring(const HeadProjection& projection, ScreenMesh& mesh) const;

  Geometry geometry_;
  Surround surround_;
  std::vector<Surround::Place> ring_;
  std::vector<RegionShares> head_shares_;
};

}  // namespace fbs
