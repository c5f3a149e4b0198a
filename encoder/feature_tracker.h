// Follows mouth and brows with B-snakes in the head's own frame. Paper section 2.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/b_snake.h"
#include "encoder/feature_map.h"
#include "encoder/pose.h"
#include "encoder/work_frame.h"

namespace fbs {

/// Snake units are 1/32 of the eye distance, so that the paper's delta_0 = 1 and sigma = 0.75 reach an eighth of it.
inline constexpr double kHeadUnitsPerSnakeUnit = kUnitsPerEyeDistance / 32.0;

/// The features that have a snake.
inline constexpr std::array<FeatureId, 3> kSnakeFeatures = {FeatureId::kMouthOuter, FeatureId::kBrowRight,
                                                            FeatureId::kBrowLeft};

class FeatureTracker {
 public:
  /// Learns what each feature looks like and lets its snake come to rest on the first picture.
  /// @param first  with colour
  FeatureTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first);

  /// @param now   with colour
  /// @param flow  where the optical flow took each vertex (pixels of the picture, nan where lost): moves the curves
  ///              first, as does the pose
  void track(const WorkFrame& now, const Pose& pose, const std::array<glm::dvec2, kVertexCount>& flow);

  /// Offsets of all control points from rest, head units.
  [[nodiscard]] std::array<glm::dvec2, kControlCount> offsets() const;

  /// Moves every snake to where `offsets` (head units) has it.
  void set_offsets(const std::array<glm::dvec2, kControlCount>& offsets);

  /// The curve of a snake as points in the head frame, head units; for drawing and for marks.
  [[nodiscard]] std::vector<glm::dvec3> outline(std::size_t snake) const;

  [[nodiscard]] std::size_t count() const { return snakes_.size(); }
  /// Iterations that the last track() needed, per snake.
  [[nodiscard]] int iterations(std::size_t snake) const { return snakes_[snake].iterations; }

 private:
  struct Snake {
    FeatureId id;
    SnakeCurve curve;
    SnakeWeights weights;
    cv::Rect2d region;                 ///< snake units, of the patch it looks at
    double depth = 0;                  ///< z of the feature's plane, head units
    FeatureMap map;
    std::vector<glm::dvec2> rest, now;  ///< control points, snake units
    std::vector<FacingPair> facing;
    cv::Mat1f seen;                    ///< feature map of the picture before
    int iterations = 0;
  };

  static Snake make(FeatureId id, const Geometry& geometry);
  [[nodiscard]] static std::array<cv::Mat, 3> patch(const Snake& s, const WorkFrame& frame, const Pose& pose);
  static void learn(Snake& s, const std::array<cv::Mat, 3>& patch);
  [[nodiscard]] static SnakeImage look(Snake& s, const std::array<cv::Mat, 3>& patch);
  [[nodiscard]] std::vector<glm::dvec2> predict(const Snake& s, const Pose& pose,
                                                const std::array<glm::dvec2, kVertexCount>& flow) const;

  std::vector<Snake> snakes_;
  std::array<glm::dvec3, kVertexCount> neutral_;  ///< head units
};

}  // namespace fbs
