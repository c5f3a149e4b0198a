// The stage of a scene's encoder that chooses, codes and places its patterns, segment by segment.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/coded_state.h"
#include "common/hooks.h"
#include "common/workers.h"
#include "decoder/scene/scene.h"
#include "encoder/segment/segment_blend.h"
#include "encoder/segment/segment_draft.h"

namespace fbs {

/// Replaces the motion of a segment by one that suits its patterns.
using StateRefit =
    std::function<Result<void>(Segment& segment, const SegmentPatterns& patterns, Workers& workers)>;

struct PatternSettings {
  double lambda = 0;        ///< squared luma levels that a bit of blend modes is worth
  double bitrate_kbps = 0;  ///< of all packets; 0: the quality decides
  double start = 0;         ///< EncoderSettings::start; 0: none
  int groups_per_key = 1;   ///< SceneTiming::groups_per_key
  int threads = 1;          ///< at least 1; the stream is the same
  Hooks hooks{};
};

class PatternStage;

/// Decides how many patterns the segments of a stage have, and what they may cost.
class PatternPolicy {
 public:
  PatternPolicy(const PatternPolicy&) = delete;
  PatternPolicy& operator=(const PatternPolicy&) = delete;
  virtual ~PatternPolicy() = default;

  virtual void begin_scene() {}
  /// The picture has been added to the segment.
  virtual void note_added(const Picture& /*picture*/) {}
  /// PatternStage::set_bitrate().
  virtual void set_bitrate(double /*kbps*/) {}
  /// PatternStage::lose_patterns().
  virtual void lose_patterns() {}
  /// PatternStage::segment_ends().
  [[nodiscard]] virtual bool segment_ends(std::size_t next) const = 0;
  /// Decides on the patterns of the segment, which is not empty, and makes them.
  /// @param other_bytes, refit  as of PatternStage::end_segment()
  [[nodiscard]] virtual Result<SegmentDraft> make_segment(const Scene& scene, std::size_t other_bytes,
                                                          const StateRefit& refit) = 0;
  /// The segment has been coded.
  /// @param packets  of the segment, in stream order; others may be added
  virtual void end_segment(std::vector<TypedPayload>& packets) = 0;

 protected:
  explicit PatternPolicy(PatternStage& stage);

  PatternStage& stage_;
  SegmentStore& store_;  ///< the stage's
  Workers& workers_;     ///< the stage's
};

/// Takes pictures and their planned motion, and returns packets, a segment at a time. What patterns there are
/// is decided by how much is known: see FilePatterns and LivePatterns.
class PatternStage {
 public:
  /// @param rest  seen state of pattern 0 as coded
  PatternStage(const VideoFormat& format, const PatternSettings& settings, const CodedState& rest);
  PatternStage(const PatternStage&) = delete;
  PatternStage& operator=(const PatternStage&) = delete;
  ~PatternStage() = default;

  /// Sets the policies, before anything else is called.
  /// @param whole  decides in the place of the other on a scene that is known whole; may be null
  void decide_by(std::unique_ptr<PatternPolicy> policy, std::unique_ptr<PatternPolicy> whole = nullptr);

  /// Another scene begins; the segment before has ended.
  /// @param rest  seen state of its pattern 0 as coded
  void begin_scene(const CodedState& rest);

  /// The next picture of the scene.
  Result<void> add(const SharedPicture& picture);
  /// The picture added next begins another shot.
  void cut() { store_.cut(); }
  /// A group ends with the picture added last.
  /// @param durations  of its pictures, 1/90000 s; 0: nominal
  void end_group(std::span<const std::uint32_t> durations) { store_.end_group(durations); }
  /// Adds the motion of the next group.
  /// @param states  of its pictures
  void add(std::span<const State> states, std::vector<std::uint8_t> payload) {
    store_.add(states, std::move(payload));
  }

  /// Where the bitrate of a live scene is limited: by this from now on, kbit/s.
  void set_bitrate(double kbps) { policy_->set_bitrate(kbps); }

  /// A viewer of a live scene has lost a pattern for good: later ones need the scene's first alone.
  void lose_patterns() { policy_->lose_patterns(); }

  /// Whether the segment should end with the group added last.
  /// @param next  pictures of the group after it
  [[nodiscard]] bool segment_ends(std::size_t next) const { return policy_->segment_ends(next); }

  /// Pictures of the segment so far.
  [[nodiscard]] std::size_t pictures() const { return store_.segment().pictures.count(); }

  /// Groups of the segment so far.
  [[nodiscard]] std::size_t groups() const { return store_.segment().groups.size(); }

  /// Patterns that the decoder keeps.
  [[nodiscard]] std::int32_t slots() const { return store_.slots(); }

  /// Codes the segment and begins another.
  /// @param scene  as the decoder has it before the segment, and after; its setup has slots()
  /// @param last   the scene ends with it
  /// @param other_bytes  written besides segments since the last one
  /// @param refit  called for segments with several patterns; may be empty
  /// @return packets
  [[nodiscard]] Result<std::vector<TypedPayload>> end_segment(Scene& scene, bool last,
                                                              std::size_t other_bytes,
                                                              const StateRefit& refit);

  // For policies.

  [[nodiscard]] SegmentStore& store() { return store_; }
  [[nodiscard]] Workers& workers() { return workers_; }
  /// Whether the stream has a pattern.
  [[nodiscard]] bool begun() const { return begun_; }

  /// How patterns are made of a draft.
  struct Making {
    /// Coding of the drafts that show where patterns err, so that they can be solved for; empty: they are
    /// not.
    std::optional<SequenceSettings> trial{};
    SolverSettings solver{};
    int refits = 0;                  ///< of the states, to patterns as sent
    std::size_t draft_pictures = 1;  ///< at most so many share modes, until the last refit
    std::size_t pictures = 1;        ///< and afterwards
    /// Codes the pictures of the draft.
    std::function<Result<void>(SegmentDraft&)> code;
  };
  /// Makes the patterns, and sets states and blend modes.
  [[nodiscard]] Result<SegmentDraft> make(const Scene& scene, SegmentDraft draft, const Making& making,
                                          const StateRefit& refit);
  /// Errors of the segment; empty: unknown, as states or patterns have changed.
  [[nodiscard]] SegmentErrors& errors() { return errors_; }
  /// Computes errors() if they are unknown.
  /// @param most  at most this many pictures share theirs
  Result<void> measure(const SegmentPatterns& patterns, std::size_t most);
  /// Sets the blend modes of the segment.
  Result<void> choose(const Scene& scene, const SegmentDraft& draft, std::size_t most);

 private:
  Workers workers_;
  SegmentStore store_;
  std::unique_ptr<PatternPolicy> policy_, whole_;
  bool begun_ = false;
  SegmentErrors errors_;
  double lambda_;
  RegionModes modes_{};  ///< of the scene's last picture
};

}  // namespace fbs
