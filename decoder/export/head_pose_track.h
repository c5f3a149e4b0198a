// Head pose and expression of a recording as the animation of a model.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "decoder/expression/expression_targets.h"
#include "decoder/export/head_recording.h"

namespace fbs {

/// Axes of models: x to the right of the picture, y up, z towards the viewer.
[[nodiscard]] inline glm::dvec3 to_model_axes(glm::dvec3 p) {
  return {p.x, -p.y, -p.z};
}

/// Places the head's vertices, in eye distances and model axes, in the picture, in pixels and model axes with
/// the origin in its upper left corner: scale, then rotation, then translation.
struct ModelPose {
  glm::dquat rotation;
  glm::dvec3 translation;
  double scale = 1;  ///< pixels per eye distance
};
[[nodiscard]] ModelPose model_pose(const State& state);

/// Vertices of the adapted head, eye distances, model axes.
[[nodiscard]] std::vector<glm::dvec3> model_vertices(const Geometry& geometry);

/// Of length one, from the triangles at each vertex weighted by their areas; towards the viewer where there
/// are none.
[[nodiscard]] std::vector<glm::vec3> vertex_normals(const std::vector<glm::dvec3>& vertices,
                                                    std::span<const std::uint16_t> corners);

/// A shape of a model: what it adds to the vertices at a weight of one, eye distances, model axes.
struct MorphTarget {
  std::string name;
  std::vector<glm::dvec3> displacements;  ///< of each vertex
};

/// The expression of a head as morph targets and their weights. To those of ExpressionTargets it adds what
/// keeps each pupil between its lids (SPEC 8.6), which is not linear in the control points: a target that
/// moves only that vertex, pupilRightDown and pupilLeftDown.
class HeadMorphs {
 public:
  explicit HeadMorphs(const Geometry& geometry);

  [[nodiscard]] const std::vector<MorphTarget>& targets() const { return targets_; }
  /// @return of each target: with them the model's vertices are those of deform(), to one head unit
  [[nodiscard]] std::vector<double> weights(const State& state) const;
  /// What moves no vertex by more than one head unit, for each target.
  [[nodiscard]] std::vector<double> tolerances() const;

 private:
  Geometry geometry_;
  ExpressionTargets expression_;
  std::vector<MorphTarget> targets_;
};

}  // namespace fbs
