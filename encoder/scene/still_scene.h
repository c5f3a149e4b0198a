// A scene without a face that shows its first picture throughout.
#pragma once

#include <memory>

#include "bitstream/motion/motion_encoder.h"
#include "encoder/plan/group_clock.h"
#include "encoder/plan/scene_timing.h"
#include "encoder/scene/scene_encoder.h"
#include "encoder/scene/scene_packets.h"

namespace fbs {

class StillScene : public SceneEncoder {
 public:
  /// @param before  where in the stream the scene begins
  static Result<std::unique_ptr<SceneEncoder>> begin(const VideoFormat& format,
                                                     const EncoderSettings& settings, const Picture& first,
                                                     const StreamPosition& before = {});

  Result<void> push(const Picture& picture, const PictureTime& when) override;
  StreamPosition end_picture(std::optional<std::uint64_t> time) override {
    if (time) clock_.end_at(*time);
    return clock_.position();
  }
  void cut() override {}
  [[nodiscard]] bool recognises(const Picture&) override { return false; }
  [[nodiscard]] bool carries_shots() const override { return false; }
  Result<void> finish() override { return end_group(); }
  [[nodiscard]] std::vector<std::uint8_t> take() override { return packets_.take(); }
  [[nodiscard]] const PictureAnalysis& analysis() const override { return analysis_; }

 private:
  StillScene(const Setup& setup, const SceneTiming& timing);
  /// Codes a group whose pictures all have the pattern's state.
  Result<void> end_group();

  SceneTiming timing_;
  PartMask parts_;
  MotionEncoder coder_;
  GroupClock clock_;
  std::uint64_t pictures_ = 0;
  ScenePackets packets_;
  PictureAnalysis analysis_;
};

}  // namespace fbs
