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
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/image/pyramid.h"
#include "encoder/image/work_frame.h"
#include "encoder/model/surface.h"

namespace fbs {

struct TrackedPose {
  Pose pose;
  double confidence = 0;  ///< 0..1: correlation of what the mesh points see with what they saw in picture 0
};

/// A work frame with the light taken out, at the sizes at which heads are compared.
struct LevelledFrame {
  static constexpr int kLevels = 3;

  explicit LevelledFrame(WorkFrame frame);
  /// Where a position in pixels of the picture lies in a level, its pixels' centres at whole numbers.
  [[nodiscard]] glm::dvec2 at(glm::dvec2 picture, int level) const;

  WorkFrame frame;
  Pyramid<kLevels> levels;  ///< 8 bit, flat is 128; [0] has luma's size, each next one half of it
};

/// The same place seen from the front: what a pose caught in a turn that is none is compared with.
[[nodiscard]] Pose frontal(const Pose& pose, const HeadVertices& vertices);

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

  /// Takes `before` as the picture before and `pose` as the head's in it: while a face is lost and when a
  /// search has found it.
  void restart(const Pose& pose, const WorkFrame& before) {
    pose_ = pose;
    before_ = before;
  }

  [[nodiscard]] const Pose& pose() const { return pose_; }

  /// Of picture 0: it sets the scale of work frames.
  [[nodiscard]] double eye_distance_px() const { return eye_distance_px_; }
  /// The points that are compared, head units, with the expression of `vertices`.
  [[nodiscard]] std::vector<glm::dvec3> surface(const HeadVertices& vertices) const;
  /// On which triangle each of them lies.
  [[nodiscard]] std::span<const SurfacePoint> points() const { return points_; }
  /// What they looked like in picture 0 at a level of LevelledFrame, of its 8 bits; negative where not seen.
  [[nodiscard]] std::span<const float> seen(int level) const { return seen_[level]; }
  /// How much each says of the head, 0..1.
  [[nodiscard]] std::span<const float> weights() const { return weight_; }

  /// How much what the points see in `now` is like what they saw in picture 0, 0..1: TrackedPose::confidence.
  [[nodiscard]] double correlation(const LevelledFrame& now, const Pose& pose,
                                   std::span<const glm::dvec3> points) const;
  /// Brings a pose that is nearly right to where picture 0 explains `now` best, from the coarsest level on.
  [[nodiscard]] TrackedPose settle(const LevelledFrame& now, const Pose& pose,
                                   const std::vector<glm::dvec3>& points) const;

 private:
  static constexpr int kLevels = LevelledFrame::kLevels;

  [[nodiscard]] Pose fit_flow(const Pose& start, const HeadVertices& vertices) const;
  void follow_flow(const WorkFrame& now, const HeadVertices& vertices);
  [[nodiscard]] Pose align(const Pyramid<kLevels>& pyramid, const WorkFrame& now, int level,
                           const Pose& start, const std::vector<glm::dvec3>& points) const;

  double eye_distance_px_;
  std::vector<SurfacePoint> points_;
  std::vector<float> weight_;                     ///< of each point
  std::array<std::vector<float>, kLevels> seen_;  ///< brightness at each point in picture 0
  Pose pose_;
  WorkFrame before_;
  std::array<glm::dvec2, kVertexCount> flow_{};
};

}  // namespace fbs
