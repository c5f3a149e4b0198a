// A scene without a face: patterns over time, blended, and moved as a plane where the camera moves.
#pragma once

#include <memory>
#include <vector>

#include "decoder/scene/scene.h"
#include "encoder/scene/scene_encoder.h"
#include "encoder/scene/scene_ledger.h"
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

  Result<void> push(const Picture& picture, const PictureTime& when) override;
  StreamPosition end_picture(std::optional<std::uint64_t> time) override;
  void cut() override;
  Result<void> change(const std::function<void(SceneLedger&)>& how) override {
    how(ledger_);
    return {};
  }
  [[nodiscard]] bool recognises(const Picture&) override { return false; }
  [[nodiscard]] bool carries_shots() const override { return true; }
  Result<void> finish() override;
  [[nodiscard]] std::vector<std::uint8_t> take() override { return ledger_.packets().take(); }
  [[nodiscard]] const PictureAnalysis& analysis() const override { return analysis_; }

 private:
  PlanarScene(const Setup& setup, const EncoderSettings& settings, const RatePlan& rate, PicturePlane plane);
  Result<void> end_group();
  /// @param last  of the scene
  Result<void> end_segment(bool last);
  /// Begins another scene with the next picture: a place to join.
  void begin_again();
  /// Fixes whether the scene's plane moves, from its first segment, and writes the head.
  Result<void> begin_motion();
  /// Whether the camera moves enough for the plane to pay: in the segment or, live, recently.
  [[nodiscard]] bool moves() const { return moved_ < kPays * still_; }
  [[nodiscard]] Result<void> add_motion();

  /// The plane moves if motion leaves less than this of the pictures' differences. Highway, whose sky and
  /// road are no plane, gains 0.1 dB at 0.7, and takes five times as long to decode.
  static constexpr double kPays = 0.5;

  /// A picture of the segment, until its motion is planned.
  struct Observed {
    Pose pose;
    cv::Matx<double, kPoseCount, kPoseCount> quadratic;
  };

  SceneLedger ledger_;
  PicturePlane plane_;
  Scene scene_;  ///< as the decoder builds it; its geometry is not sent where the plane rests
  GlobalMotion global_;
  bool moving_ = false;           ///< the scene has a plane that moves
  double moved_ = 0, still_ = 0;  ///< sums of Observation::moved and still, for moves()
  std::vector<Observed> observed_;
  std::vector<std::vector<std::uint32_t>> groups_;  ///< of the segment: durations of their pictures
  PictureAnalysis analysis_;
};

}  // namespace fbs
