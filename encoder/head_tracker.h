// Global motion: six numbers of head pose per picture. The paper leaves this to "traditional techniques".
//
// First guess: pyramidal Lucas-Kanade flow of mesh points from picture to picture and a robust fit of the
// pose. Then the guess is brought back to the truth of the first picture: the pose minimises the robust
// difference between the present picture and the first picture's brightness at points fixed on the mesh
// (direct alignment, as in Baker & Matthews 2004 but additive, since the pose is no group under weak
// perspective). So nothing drifts.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/image_alignment.h"
#include "encoder/work_frame.h"

namespace fbs {

struct TrackedPose {
  Pose pose;
  double confidence = 0;  ///< 0..1: correlation of what the mesh points see with what they saw in picture 0
};

class HeadTracker {
 public:
  /// @param first  the scene's first picture, in which the head is seen in `pose`
  HeadTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first);

  /// @param now       the next picture's work frame, cut anywhere near the head
  /// @param vertices  head-frame positions with the expression of the picture before (head units)
  TrackedPose track(const WorkFrame& now, const HeadVertices& vertices);

  /// Where the flow took each vertex of the mesh, pixels of the picture; nan where it was lost. Of the last
  /// track().
  [[nodiscard]] const std::array<glm::dvec2, kVertexCount>& flow() const { return flow_; }

  /// Takes `pose` as that of the picture before: after a search for a lost face.
  void restart(const Pose& pose) { pose_ = pose; }

  [[nodiscard]] const Pose& pose() const { return pose_; }

 private:
  static constexpr int kLevels = 3;

  [[nodiscard]] Pose fit_flow(const Pose& start, const HeadVertices& vertices) const;
  void follow_flow(const WorkFrame& now, const HeadVertices& vertices);
  [[nodiscard]] Pose align(const std::vector<cv::Mat>& pyramid, const WorkFrame& now, int level,
                           const Pose& start, const std::vector<glm::dvec3>& points) const;
  [[nodiscard]] double correlation(const cv::Mat& luma, const WorkFrame& now, const Pose& pose,
                                   const std::vector<glm::dvec3>& points) const;
  [[nodiscard]] std::vector<glm::dvec3> surface(const HeadVertices& vertices) const;

  std::vector<SurfacePoint> points_;
  std::vector<float> weight_;                     ///< of each point
  std::array<std::vector<float>, kLevels> seen_;  ///< brightness at each point in picture 0
  Pose pose_;
  WorkFrame before_;
  std::array<glm::dvec2, kVertexCount> flow_{};
};

}  // namespace fbs
