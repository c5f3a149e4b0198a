// Global motion: six numbers of head pose per picture. The paper leaves this to "traditional techniques".
#pragma once

#include "bitstream/syntax.h"
#include "encoder/track/head/head_appearance.h"
#include "encoder/track/head/mesh_flow.h"

namespace fbs {

/// First guess: a robust fit of the pose to the mesh's optical flow (MeshFlow). The guess is then refined to
/// the pose at which the present picture best matches the first one's brightness at points fixed on the mesh
/// (HeadAppearance), so that nothing drifts.
class HeadTracker {
 public:
  /// @param first  the scene's first picture, in which the head is seen in `pose`
  HeadTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first);

  /// @param now       the next picture's work frame, cut anywhere near the head
  /// @param vertices  head-frame positions with the expression of the picture before (head units)
  TrackedPose track(const WorkFrame& now, const HeadVertices& vertices);

  /// Makes `before` the previous picture and `pose` the head's pose in it: while a face is lost and when a
  /// search has found it.
  void restart(const Pose& pose, const WorkFrame& before) {
    pose_ = pose;
    before_ = before;
  }

  [[nodiscard]] const Pose& pose() const { return pose_; }
  /// The flow of the last track().
  [[nodiscard]] const MeshFlow& flow() const { return flow_; }
  [[nodiscard]] const HeadAppearance& appearance() const { return appearance_; }

 private:
  HeadAppearance appearance_;
  Pose pose_;
  WorkFrame before_;
  MeshFlow flow_{};
};

}  // namespace fbs
