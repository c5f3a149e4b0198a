// The whole picture as a plane that a camera pans, rolls and zooms over. The format moves the picture with a
// head, so the plane stands in the place of one: the generic head, flat and many times as large as the
// picture. The ground's motion would not do: beyond the borders of the rest state the surround repeats them,
// where a pattern of a pan shows something.
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
  /// As decoded, and the payload of its packet.
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] const std::vector<std::uint8_t>& payload() const { return payload_; }

  /// Steps of the pose: one of rotation or scale moves a corner of the picture as far as one of translation.
  /// @param step_px  of translation, pixels
  [[nodiscard]] QuantiserSteps steps(double step_px) const;

  /// The plane where it has moved.
  [[nodiscard]] Pose pose(const PlaneMotion& motion) const;

  /// Whether it fills the picture there.
  [[nodiscard]] bool covers(const PlaneMotion& motion) const;

  /// What other poses would cost: squared luma differences over the picture, by the numbers of State::pose.
  [[nodiscard]] static cv::Matx<double, kPoseCount, kPoseCount> quadratic(
      const GlobalMotion::Observation& observation);

 private:
  PicturePlane() = default;
  double half_diagonal_ = 0;  ///< of the picture, pixels
  Pose rest_;
  Geometry geometry_;
  std::vector<std::uint8_t> payload_;
};

/// A plane without extent: for scenes that do not move. Nothing of it is drawn, so that it need not be sent.
[[nodiscard]] inline Geometry no_plane() {
  return {};
}

}  // namespace fbs
