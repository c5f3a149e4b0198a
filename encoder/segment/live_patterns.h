// Patterns of a live scene: sent when they pay for past pictures, and solved for where the delay is long.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/workers.h"
#include "encoder/patterns/live_sequence.h"
#include "encoder/plan/live_rate.h"
#include "encoder/plan/pattern_regret.h"
#include "encoder/plan/pattern_replacement.h"
#include "encoder/segment/pattern_stage.h"
#include "encoder/segment/segment_draft.h"

namespace fbs {

struct LivePatternSettings : PatternSettings {
  double delay = 0.2;    ///< LiveSettings::delay
  bool solves = false;   ///< for patterns, where the delay is long
  int quantiser = 58;    ///< libaom's scale; for all patterns but a scene's first. Beyond 63 they get rarer
  bool reduced = false;  ///< patterns are coded at half width and height
  bool refits = true;    ///< states are fitted to the blend
  double buffer = 0;     ///< LiveSettings::buffer
  bool alone = false;    ///< each pattern needs the first alone
  bool refines = true;   ///< without a bitrate, a still head gets a finer pattern
};

/// What is known is a window of pictures, which is a segment: a group where the delay is short, or all groups
/// of a long delay. Patterns go on from window to window as one AV1 sequence.
class LivePatterns : public PatternPolicy {
 public:
  LivePatterns(PatternStage& stage, const LivePatternSettings& settings);
  /// Whether a delay, s, is long enough for segments of several groups.
  [[nodiscard]] static bool has_windows(double delay);

  void begin_scene() override;
  void set_bitrate(double kbps) override {
    if (rate_) rate_->set(kbps);
  }
  void lose_patterns() override { sequence_.lose_patterns(); }
  [[nodiscard]] bool segment_ends(std::size_t next) const override;
  [[nodiscard]] Result<SegmentDraft> make_segment(const Scene& scene, std::size_t other_bytes,
                                                  const StateRefit& refit) override;
  void end_segment(std::vector<TypedPayload>& packets) override;

 private:
  /// Patterns to be made of the segment.
  struct Plan {
    std::vector<std::size_t> times;  ///< their pictures, rising
    int first = 0, others = 0;       ///< quantisers
    bool key = false;                ///< the first of them is not predicted
    /// Most bytes of the scene's first pattern, if it is coarse.
    std::optional<std::size_t> start{};
  };
  /// The quantiser to code a picture of the segment with that nothing predicts.
  /// @param room  bytes that it may take
  [[nodiscard]] Result<int> key_quantiser(const Scene& scene, std::size_t time, double room);
  /// Most bytes of the frame of a scene's first pattern, which is coarse if need be. The stream's first has
  /// to arrive in time.
  [[nodiscard]] double first_room() const;
  /// Plans a scene's first segment.
  [[nodiscard]] Result<Plan> plan_first(const Scene& scene);
  /// Plans another one, by the errors of its pictures without patterns of their own.
  /// @param shared  unknown errors are shared by at most this many pictures
  [[nodiscard]] Result<Plan> plan_next(const Scene& scene, std::size_t shared);
  /// Adds patterns that pay.
  /// @param least  error of each picture
  /// @param begin  picture from which on they count
  /// @param room   bytes that may be sent now
  void add_paying(std::span<const double> least, std::size_t begin, double room, Plan& plan);
  /// Patterns to buy now.
  struct Bought {
    int quantiser;
    std::size_t patterns = 1;  ///< in this group
  };
  /// The next patterns, if buying them now pays.
  /// @param whole  nothing predicts the next one
  /// @param error  of the pictures next to it, drawn without it
  [[nodiscard]] std::optional<Bought> paying(double room, bool whole, double error);
  /// The same with a rate.
  [[nodiscard]] std::optional<Bought> paying_at_rate(double room, bool whole, double error);
  /// With a rate, what a bit of a pattern is worth so that patterns take what motion leaves of it, squared
  /// luma levels.
  [[nodiscard]] double price(const PatternReplacement::Offers& offers,
                             const PatternReplacement::Timing& timing);
  /// Pictures a second in the segment.
  [[nodiscard]] double fps() const;
  /// Bytes that may be sent now.
  [[nodiscard]] double room() const;
  /// The same for frames of patterns: what else the segment has is left out, approximately.
  [[nodiscard]] double pattern_room() const;
  /// Codes the pictures of a draft.
  Result<void> code(const Scene& scene, const Plan& plan, SegmentDraft& draft);
  /// Remembers the errors of the segment as sent.
  void learn_errors(const Plan& plan);
  /// Inserts the packets of the previous group ahead of this group's packets, if sending them again pays.
  void repeat(std::vector<TypedPayload>& packets);

  LivePatternSettings settings_;
  LiveSequence sequence_;
  std::optional<LiveRate> rate_;
  bool over_ = false;  ///< the rate has no room
  int wanted_ = 0;     ///< quantiser of the last pattern that nothing predicted, if there had been room
  std::optional<double> price_;  ///< with a rate: price(), once known
  double motion_ = 0;            ///< bits a second of all but patterns, smoothed
  PatternSizes sizes_;
  PatternReplacement replacement_;  ///< decides with a rate
  // The scene's:
  PatternRegret regret_;              ///< decides by quality
  std::ptrdiff_t since_pattern_ = 0;  ///< pictures from the last pattern, or cut, to the segment's first
  std::size_t next_slot_ = 0;
  double head_ = 0;  ///< bytes of its head besides the pattern
  double age_ = 0;   ///< s
  /// The group before, if a viewer who loses it lacks a pattern.
  std::vector<TypedPayload> with_pattern_;
  double gain_ = 0;    ///< of the last pattern, until it is as old as the one before was: squared luma levels
  double coarse_ = 0;  ///< bytes of the first pattern, until a finer one takes its place; 0: it is fine
};

}  // namespace fbs
