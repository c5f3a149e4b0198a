// Tries a grid of poses at the coarsest level, where one takes microseconds: whole pixels and few points.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "encoder/track/head/head_appearance.h"

namespace fbs {

/// Poses around one: steps of rotation (rad) and size (log2), and the radius of places (eye distances).
struct PoseGrid {
  std::span<const double> yaw, pitch, size;
  double reach;
};

/// The best place for each rotation and size of the grid, likeliest first. Their confidences are coarse
/// correlations, not comparable with HeadAppearance's.
/// @param centre  of the grid
[[nodiscard]] std::vector<TrackedPose> search_coarsely(const HeadAppearance& head,
                                                       const HeadVertices& vertices, const LevelledFrame& now,
                                                       const Pose& centre, const PoseGrid& grid);

/// Correlates the head's appearance with a picture at the coarsest level. Holds references: for one picture.
class CoarseCorrelation {
 public:
  CoarseCorrelation(const HeadAppearance& head, const HeadVertices& vertices, const LevelledFrame& now);

  /// The middle of the points, the centre of the head's rotation.
  [[nodiscard]] glm::dvec3 centre() const { return centre_; }

  /// The best place within `reach_px` pixels of the picture around `pose`.
  [[nodiscard]] TrackedPose best_place(Pose pose, double reach_px);

 private:
  static constexpr int kLevel = LevelledFrame::kLevels - 1;

  struct Point {
    glm::dvec3 place;
    HeadTriangle corner;
    float seen, weight;
  };
  struct Tap {
    glm::ivec2 at;            ///< in level_
    float weight, deviation;  ///< of the luma seen: from its mean, times the weight
  };

  void set_pose(const Pose& pose);
  void add_tap(const Point& point, glm::dvec2 at);
  /// Subtracts the taps' mean.
  void centre_taps();
  [[nodiscard]] double correlation(glm::ivec2 shift) const;

  const LevelledFrame& now_;
  const HeadVertices& vertices_;
  std::vector<Point> points_;
  glm::dvec3 centre_{0, 0, 0};
  cv::Mat level_;  ///< with a border
  std::vector<Tap> taps_;
  glm::ivec2 low_{}, high_{};  ///< bounds of the taps
  float weight_ = 0, mean_ = 0, variance_ = 0;
};

}  // namespace fbs
