// The stage of a scene's encoder that chooses, codes and places its patterns, segment by segment.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bitstream/coded_state.h"
#include "decoder/scene/scene.h"
#include "encoder/segment/segment_blend.h"

namespace fbs {

/// Replaces the motion of a segment by one that suits its patterns.
using StateRefit =
    std::function<Result<void>(Segment& segment, const SegmentPatterns& patterns, Workers& workers)>;

/// Takes pictures and their planned motion, and returns packets, a segment at a time.
class PatternStage {
 public:
  PatternStage() = default;
  PatternStage(const PatternStage&) = delete;
  PatternStage& operator=(const PatternStage&) = delete;
  virtual ~PatternStage() = default;

  /// Another scene begins; the segment before has ended.
  /// @param rest  seen state of its pattern 0 as coded
  virtual void begin_scene(const CodedState& rest) = 0;

  /// The next picture of the scene.
  virtual Result<void> add(const Picture& picture) = 0;
  /// The picture added next begins another shot.
  virtual void cut() = 0;
  /// Adds the next group of pictures.
  /// @param states  of its pictures
  virtual void add(std::span<const State> states, std::vector<std::uint8_t> payload) = 0;

  /// Where the bitrate of a live scene is limited: by this from now on, kbit/s.
  virtual void set_bitrate(double /*kbps*/) {}

  /// A viewer of a live scene has lost a pattern for good: later ones need the scene's first alone.
  virtual void lose_patterns() {}

  /// Whether the segment should end with the group added last.
  /// @param next  pictures of the group after it
  [[nodiscard]] virtual bool segment_ends(std::size_t next) const = 0;

  /// Pictures of the segment so far.
  [[nodiscard]] virtual std::size_t pictures() const = 0;

  /// Patterns that the decoder keeps.
  [[nodiscard]] virtual std::int32_t store() const = 0;

  /// Codes the segment and begins another.
  /// @param scene  as the decoder has it before the segment, and after; its setup has store()
  /// @param other_bytes  written besides segments since the last one
  /// @param refit  called for segments with several patterns; may be empty
  /// @return packets
  [[nodiscard]] virtual Result<std::vector<TypedPayload>> end_segment(Scene& scene, std::size_t other_bytes,
                                                                      const StateRefit& refit) = 0;
};

}  // namespace fbs
