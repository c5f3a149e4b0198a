// The account of a scene that is being coded: groups, segments and scenes, and the packets that they became.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "decoder/scene/scene.h"
#include "encoder/plan/group_clock.h"
#include "encoder/plan/motion_track.h"
#include "encoder/plan/scene_timing.h"
#include "encoder/scene/scene_packets.h"
#include "encoder/segment/pattern_stage.h"

namespace fbs {

/// Knows when a group, a segment and a scene end; what each shows is its owner's business. One object serves
/// all scenes in a row that go on with the same person or plane.
class SceneLedger {
 public:
  /// @param setup     of the first scene
  /// @param seen      of its pattern 0
  /// @param patterns  nothing: one pattern, which the head brings
  SceneLedger(const Setup& setup, const CodedState& seen, const RatePlan& rate,
              const EncoderSettings& settings, std::unique_ptr<PatternStage> patterns);

  /// Counts a picture. The pattern stage gets it, too, if there is one.
  Result<void> add(const SharedPicture& picture, const PictureTime& when);
  /// GroupClock::end_at() of the picture added last.
  void end_picture(std::uint64_t time) { clock_.end_at(time); }
  /// Behind the picture added last.
  [[nodiscard]] const StreamPosition& position() const { return clock_.position(); }
  /// Whether a group ends with the picture added last.
  [[nodiscard]] bool group_ends() const {
    return timing_.group_ends(clock_.pictures(), clock_.lasts(), clock_.last(), pictures_) || is_full();
  }
  /// The next picture is shown there, behind another scene's. No group has begun.
  void go_on(const StreamPosition& at);

  /// Begins another group.
  /// @return durations of the pictures of the group before: empty if it has none
  [[nodiscard]] std::vector<std::uint32_t> end_group();
  [[nodiscard]] bool in_group() const { return clock_.pictures() > 0; }

  /// Plans the motion of a group.
  Result<void> plan(std::span<const PictureCost> costs, std::span<const std::uint32_t> durations);
  /// As after the group planned last.
  [[nodiscard]] const MotionTrack& motion() const { return motion_; }
  void set_motion(MotionTrack motion) { motion_ = std::move(motion); }

  [[nodiscard]] bool segment_ends() const {
    return patterns_ && (patterns_->segment_ends(timing_.group_pictures) || is_full());
  }
  /// Writes the packets of the segment, whose groups have all been planned. The head has been written.
  /// @param last  the scene ends with it
  Result<void> end_segment(Scene& scene, bool last, const StateRefit& refit);

  void set_bitrate(double kbps) {
    if (patterns_) patterns_->set_bitrate(kbps);
  }
  void lose_patterns() {
    if (patterns_) patterns_->lose_patterns();
  }
  /// Ends a live scene with its present group, unless it has ended already.
  void request_scene() { requested_ = !ended_; }
  /// Whether the next picture is to begin another scene.
  [[nodiscard]] bool scene_ends() const;
  void end_scene() {
    ended_ = true;
    requested_ = false;
  }
  /// Whether the next picture begins another scene.
  [[nodiscard]] bool scene_ended() const { return ended_; }
  /// Another scene begins with the next picture.
  void begin_again(Setup& setup);
  /// Motion is planned from a new pattern 0 on.
  void begin_motion(const Setup& setup, const CodedState& seen);

  [[nodiscard]] const SceneTiming& timing() const { return timing_; }
  [[nodiscard]] const RatePlan& rate() const { return rate_; }
  [[nodiscard]] bool live() const { return live_; }
  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }  ///< of the scene
  /// Null with one pattern.
  [[nodiscard]] PatternStage* patterns() const { return patterns_.get(); }
  [[nodiscard]] ScenePackets& packets() { return packets_; }

 private:
  /// Whether the scene is as long as it may be.
  [[nodiscard]] bool is_full() const {
    return timing_.scene_is_full(clock_.position().time - begin_, clock_.last());
  }

  SceneTiming timing_;
  RatePlan rate_;
  bool live_;
  std::unique_ptr<PatternStage> patterns_;
  MotionTrack motion_;
  GroupClock clock_;
  std::uint64_t begin_;         ///< of the scene, as position().time
  std::uint64_t pictures_ = 0;  ///< of the scene
  bool requested_ = false;      ///< the scene ends with its present group
  bool ended_ = false;
  /// Where the segment goes on behind another scene, by the number of a group.
  std::vector<std::pair<std::size_t, Return>> returns_;
  ScenePackets packets_;
};

}  // namespace fbs
