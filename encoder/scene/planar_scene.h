// A scene without a face: patterns over time, blended, and moved as a plane where the camera moves.
#pragma once

#include <memory>
#include <vector>

#include "decoder/scene/scene.h"
#include "encoder/plan/motion_track.h"
#include "encoder/plan/scene_timing.h"
#include "encoder/scene/scene_encoder.h"
#include "encoder/scene/scene_packets.h"
#include "encoder/segment/pattern_stage.h"
#include "encoder/surround/global_motion.h"
#include "encoder/surround/picture_plane.h"

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
  void request_scene() override { requested_ = !ended_; }
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
  /// Whether the camera moves so much that the plane pays: in the segment, or lately where it is live.
  [[nodiscard]] bool moves() const { return moved_ < kPays * still_; }
  [[nodiscard]] Result<void> add_motion();

  /// The plane moves if motion leaves less than this of the pictures' differences. Highway, whose sky and
  /// road are no plane, gains 0.1 dB at 0.7, and takes five times as long to decode.
  static constexpr double kPays = 0.5;

  /// A picture of the segment, until its motion is planned.
  struct Observed {
    Pose pose;
    cv::Matx<double, kPoseCount, kPoseCount> quadratic;
    std::uint32_t duration;
  };

  SceneTiming timing_;
  RatePlan rate_;
  PicturePlane plane_;
  double key_interval_;  ///< pictures; 0: a scene ends with its segment
  Scene scene_;          ///< as the decoder builds it; its geometry is not sent where the plane rests
  GlobalMotion global_;
  MotionTrack motion_;
  std::unique_ptr<PatternStage> patterns_;
  bool live_;
  bool moving_ = false;           ///< the scene has a plane that moves
  double moved_ = 0, still_ = 0;  ///< sums of Observation::moved and still that moves() goes by
  std::vector<Observed> observed_;
  std::vector<std::size_t> groups_;  ///< pictures of each group of the segment
  std::size_t in_group_ = 0;         ///< pictures of the group so far
  std::uint64_t pictures_ = 0;       ///< of the scene
  bool requested_ = false;           ///< the scene ends with its present group
  bool ended_ = false;               ///< the next picture begins another scene
  StreamPosition position_;          ///< behind the last picture
  ScenePackets packets_;
  PictureAnalysis analysis_;
};

}  // namespace fbs
