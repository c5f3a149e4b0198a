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

/// Maps the head's vertices, in eye distances and model axes, to the picture, in pixels and model axes with
/// the origin in its upper left corner: scale, then rotation, then translation.
struct ModelPose {
  glm::dquat rotation;
  glm::dvec3 translation;
  double scale = 1;  ///< pixels per eye distance
};
[[nodiscard]] ModelPose model_pose(const State& state);

/// Vertices of the adapted head, eye distances, model axes.
[[nodiscard]] std::vector<glm::dvec3> model_vertices(const Geometry& geometry);

/// Unit normals from the triangles at each vertex, weighted by area; towards the viewer where there are none.
[[nodiscard]] std::vector<glm::vec3> vertex_normals(const std::vector<glm::dvec3>& vertices,
                                                    std::span<const std::uint16_t> corners);

/// A shape of a model: displacement of the vertices at a weight of one, eye distances, model axes.
struct MorphTarget {
  std::string name;
  std::vector<glm::dvec3> displacements;  ///< of each vertex
};

/// The expression of a head as morph targets and their weights. Adds two to ExpressionTargets, pupilRightDown
/// and pupilLeftDown: each moves only the pupil's vertex and keeps it between its lids (SPEC 8.6), which is
/// not linear in the control points.
class HeadMorphs {
 public:
  explicit HeadMorphs(const Geometry& geometry);

  [[nodiscard]] const std::vector<MorphTarget>& targets() const { return targets_; }
  /// @return one for each target: with them the model's vertices match deform() to one head unit
  [[nodiscard]] std::vector<double> weights(const State& state) const;
  /// For each target, the largest weight that moves no vertex by more than one head unit.
  [[nodiscard]] std::vector<double> tolerances() const;

 private:
  Geometry geometry_;
  ExpressionTargets expression_;
  std::vector<MorphTarget> targets_;
};

}  // namespace fbs
