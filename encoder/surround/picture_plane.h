// The whole picture as a plane over which a camera pans, rolls and zooms. The format moves pictures with a
// head, so the plane takes its place: the generic head, flattened and many times as large as the picture. The
// ground's motion would not do: beyond the borders of the rest state the surround repeats them, where a
// pattern from a pan has content.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"
#include "decoder/animate/scene_geometry.h"
#include "encoder/model/pose.h"
#include "encoder/surround/global_motion.h"

namespace fbs {

class PicturePlane {
 public:
  /// @return errors of encode_geometry()
  static Result<PicturePlane> create(const VideoFormat& format);

  /// Pose of the plane at rest.
  [[nodiscard]] const Pose& rest() const { return rest_; }
  /// As decoded, with the payload of its packet.
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] const std::vector<std::uint8_t>& payload() const { return payload_; }

  /// Steps of the pose: a step of rotation or scale moves a corner of the picture as far as a step of
  /// translation.
  /// @param step_px  of translation, pixels
  [[nodiscard]] QuantiserSteps steps(double step_px) const;

  /// The plane's pose after a motion.
  [[nodiscard]] Pose pose(const PlaneMotion& motion) const;

  /// Whether the plane fills the picture after a motion.
  [[nodiscard]] bool covers(const PlaneMotion& motion) const;

  /// Cost of other poses: squared luma differences over the picture, by the numbers of State::pose.
  [[nodiscard]] static cv::Matx<double, kPoseCount, kPoseCount> quadratic(
      const GlobalMotion::Observation& observation);

 private:
  PicturePlane() = default;
  double half_diagonal_ = 0;  ///< of the picture, pixels
  Pose rest_;
  Geometry geometry_;
  std::vector<std::uint8_t> payload_;
};

/// A plane without extent, for scenes without motion. Nothing of it is drawn, so that it need not be sent.
[[nodiscard]] inline Geometry no_plane() {
  return {};
}

}  // namespace fbs
