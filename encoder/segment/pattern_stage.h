// The stage of a scene's encoder that chooses, codes and places its patterns, segment by segment.
#pragma once

#include <cstdint>
#include <functional>
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

/// Takes pictures and their planned motion, and returns packets, a segment at a time. How many patterns there
/// are and what they may cost is decided by how much is known: see FilePatterns and LivePatterns.
class PatternStage {
 public:
  PatternStage(const PatternStage&) = delete;
  PatternStage& operator=(const PatternStage&) = delete;
  virtual ~PatternStage() = default;

  /// Another scene begins; the segment before has ended.
  /// @param rest  seen state of its pattern 0 as coded
  virtual void begin_scene(const CodedState& rest);

  /// The next picture of the scene.
  virtual Result<void> add(const SharedPicture& picture) { return store_.add(picture); }
  /// The picture added next begins another shot.
  void cut() { store_.cut(); }
  /// Adds the next group of pictures.
  /// @param states  of its pictures
  void add(std::span<const State> states, std::vector<std::uint8_t> payload) {
    store_.add(states, std::move(payload));
  }

  /// Where the bitrate of a live scene is limited: by this from now on, kbit/s.
  virtual void set_bitrate(double /*kbps*/) {}

  /// A viewer of a live scene has lost a pattern for good: later ones need the scene's first alone.
  virtual void lose_patterns() {}

  /// Whether the segment should end with the group added last.
  /// @param next  pictures of the group after it
  [[nodiscard]] virtual bool segment_ends(std::size_t next) const = 0;

  /// Pictures of the segment so far.
  [[nodiscard]] std::size_t pictures() const { return store_.segment().pictures.count(); }

  /// Patterns that the decoder keeps.
  [[nodiscard]] std::int32_t store() const { return store_.slots(); }

  /// Codes the segment and begins another.
  /// @param scene  as the decoder has it before the segment, and after; its setup has store()
  /// @param other_bytes  written besides segments since the last one
  /// @param refit  called for segments with several patterns; may be empty
  /// @return packets
  [[nodiscard]] Result<std::vector<TypedPayload>> end_segment(Scene& scene, std::size_t other_bytes,
                                                              const StateRefit& refit);

 protected:
  /// @param rest  seen state of pattern 0 as coded
  PatternStage(const VideoFormat& format, const PatternSettings& settings, const CodedState& rest);

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

  /// Decides on the patterns of the segment, which is not empty, and makes them.
  [[nodiscard]] virtual Result<SegmentDraft> make_segment(const Scene& scene, std::size_t other_bytes,
                                                          const StateRefit& refit) = 0;
  /// Packets of the segment are as made, and take so many bytes.
  virtual void note_sent(std::size_t bytes) = 0;

  /// Makes the patterns, and sets states and blend modes.
  [[nodiscard]] Result<SegmentDraft> make(const Scene& scene, SegmentDraft draft, const Making& making,
                                          const StateRefit& refit);
  /// Computes errors_ if they are unknown.
  /// @param most  at most this many pictures share theirs
  Result<void> measure(const SegmentPatterns& patterns, std::size_t most);
  /// Sets the blend modes of the segment.
  Result<void> choose(const Scene& scene, const SegmentDraft& draft, std::size_t most);

  Workers workers_;
  SegmentStore store_;
  bool begun_ = false;    ///< the stream has a pattern
  SegmentErrors errors_;  ///< empty: unknown, as states or patterns have changed

 private:
  double lambda_;
  RegionModes modes_{};  ///< of the scene's last picture
};

}  // namespace fbs
