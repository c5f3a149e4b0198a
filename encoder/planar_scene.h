// A scene without a face: patterns over time, blended, and moved as a plane where the camera moves.
#pragma once

#include <memory>
#include <vector>

#include "decoder/scene.h"
#include "encoder/motion_track.h"
#include "encoder/pattern_pass.h"
#include "encoder/picture_plane.h"
#include "encoder/scene_encoder.h"
#include "encoder/scene_packets.h"
#include "encoder/scene_timing.h"
#include "encoder/surround/global_motion.h"

namespace fbs {

/// Each segment is a scene of its own, unless a key interval is set. Carries all shots without a face.
class PlanarScene : public SceneEncoder {
 public:
  /// @param before  where in the stream the scene begins
  static Result<std::unique_ptr<SceneEncoder>> begin(const VideoFormat& format,
                                                     const EncoderSettings& settings,
                                                     const StreamPosition& before = {});

  Result<void> push(const Picture& picture, std::uint32_t duration) override;
  void cut() override;
  [[nodiscard]] bool recognises(const Picture&) override { return false; }
  [[nodiscard]] bool carries_shots() const override { return true; }
  Result<void> finish() override;
  [[nodiscard]] std::vector<std::uint8_t> take() override { return packets_.take(); }
  [[nodiscard]] const PictureAnalysis& analysis() const override { return analysis_; }

 private:
  PlanarScene(const Setup& setup, const EncoderSettings& settings, const RatePlan& rate, PicturePlane plane);
  Result<void> end_group();
  Result<void> end_segment();
  /// The next picture begins another scene: a place to join.
  void begin_again();
  /// Fixes whether the scene's plane moves, from its first segment, and writes the head.
  Result<void> begin_motion();
  /// Whether the camera moves so much in the segment that the plane pays.
  [[nodiscard]] bool moves() const;
  [[nodiscard]] Result<void> add_motion();

  /// A picture of the segment, until its motion is planned.
  struct Observed {
    Pose pose;
    cv::Matx<double, kPoseCount, kPoseCount> quadratic;
    double moved, still;  ///< GlobalMotion::Observation
    std::uint32_t duration;
  };

  SceneTiming timing_;
  RatePlan rate_;
  PicturePlane plane_;
  double key_interval_;  ///< pictures; 0: a scene ends with its segment
  Scene scene_;          ///< as the decoder builds it; its geometry is not sent where the plane rests
  GlobalMotion global_;
  MotionTrack motion_;
  PatternPass patterns_;
  std::vector<Observed> observed_;
  std::vector<std::size_t> groups_;  ///< pictures of each group of the segment
  std::size_t in_group_ = 0;         ///< pictures of the group so far
  std::uint64_t pictures_ = 0;       ///< of the scene
  bool ended_ = false;               ///< the next picture begins another scene
  StreamPosition position_;          ///< behind the last picture
  ScenePackets packets_;
  PictureAnalysis analysis_;
};

}  // namespace fbs
