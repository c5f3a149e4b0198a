// Follows lips, brows and upper lids with B-snakes in the head's own frame. Paper section 2.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "encoder/track/head/mesh_flow.h"
#include "encoder/track/snake/feature_snake.h"

namespace fbs {

/// The features with a snake, in tracking order. Inner lips and lids go beyond the paper.
inline constexpr std::array<FeatureId, 6> kSnakeFeatures = {
    FeatureId::kMouthOuter, FeatureId::kMouthInner,    FeatureId::kBrowRight,
    FeatureId::kBrowLeft,   FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft};

class FeatureTracker {
 public:
  /// Learns the look of each feature; its snake descends on the first picture and rests there.
  /// @param first     with colour
  /// @param descends  whether snakes descend in later pictures, too; else each stays at the best of its
  ///                  starts
  FeatureTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first, bool descends = true);

  /// @param now   with colour
  /// @param flow  of the mesh: like the pose, moves the curves first
  void track(const WorkFrame& now, const Pose& pose, const MeshFlow& flow);

  /// Offsets of all control points from rest, head units; for the inner lips from where the outer lips carry
  /// them.
  [[nodiscard]] std::array<glm::dvec2, kControlCount> offsets() const;

  /// Moves every snake to these offsets (head units).
  void set_offsets(const std::array<glm::dvec2, kControlCount>& offsets);

  /// The curve of a snake as points in the head frame, head units; for drawing and for marks.
  [[nodiscard]] std::vector<glm::dvec3> outline(std::size_t snake) const;
  /// Whether the curve is closed.
  [[nodiscard]] bool is_closed(std::size_t snake) const { return snakes_[snake].curve.is_closed(); }

  /// The vertices on the present curves: vertex and position in the head frame (head units).
  [[nodiscard]] std::vector<std::pair<std::size_t, glm::dvec3>> vertices() const;

  [[nodiscard]] std::size_t count() const { return snakes_.size(); }
  /// Iterations of the last track(), per snake.
  [[nodiscard]] int iterations(std::size_t snake) const { return snakes_[snake].iterations; }

 private:
  /// The snake's rest when only the features that carry it have moved.
  [[nodiscard]] std::vector<glm::dvec2> carried_rest(const FeatureSnake& s) const;
  /// Control points that follow the snake's vertices to where the flow takes them.
  [[nodiscard]] std::vector<glm::dvec2> predict(const FeatureSnake& s, const Pose& pose,
                                                const MeshFlow& flow) const;
  /// Control points from which a descent may start.
  [[nodiscard]] std::vector<std::vector<glm::dvec2>> starts(const FeatureSnake& s, const Pose& pose,
                                                            const MeshFlow& flow,
                                                            const std::vector<glm::dvec2>& rest) const;

  bool descends_;
  std::vector<FeatureSnake> snakes_;
  std::array<glm::dvec3, kVertexCount> neutral_;  ///< head units
};

}  // namespace fbs
