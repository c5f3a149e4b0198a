// The segment that a pattern stage gathers, and what goes on from one segment of a scene to the next.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/coded_state.h"
#include "bitstream/pattern/pattern_packet.h"
#include "decoder/scene/scene.h"
#include "encoder/segment/segment.h"

namespace fbs {

/// Numbers pictures, keeps the decoder's slots, and codes what a segment says of its pictures. Which of them
/// become patterns is its owner's business.
class SegmentStore {
 public:
  /// The coders that adapt through the scene, besides motion's. A value: a copy continues independently.
  struct Coders {
    PatternPacketWriter patterns;
    BlendEncoder blends;
  };

  /// @param rest  seen state of pattern 0 as coded
  /// @param groups_per_key  SceneTiming::groups_per_key
  SegmentStore(const VideoFormat& format, const CodedState& rest, int groups_per_key);

  /// Another scene begins; the segment before has ended.
  void begin_scene(const CodedState& rest);
  /// The next picture.
  Result<void> add(SharedPicture picture);
  /// The picture added next begins another shot.
  void cut() { cut_ = true; }
  /// The next group of the pictures.
  void add(std::span<const State> states, std::vector<std::uint8_t> payload);
  /// A group ends with the picture added last.
  /// @param durations  of its pictures, 1/90000 s; 0: nominal
  void end_group(std::span<const std::uint32_t> durations);
  /// Begins another segment.
  void end_segment();

  [[nodiscard]] Segment& segment() { return segment_; }
  [[nodiscard]] const Segment& segment() const { return segment_; }
  /// Whether it is the scene's first.
  [[nodiscard]] bool is_first() const { return picture_ == 0; }
  /// Its length, at the end of a group.
  [[nodiscard]] double seconds() const;
  /// Bytes of its motion.
  [[nodiscard]] double motion_bytes() const;
  /// Number within the scene of a picture of the segment.
  [[nodiscard]] std::int32_t number_of(std::size_t time) const {
    return picture_ + static_cast<std::int32_t>(time);
  }

  [[nodiscard]] const VideoFormat& format() const { return format_; }
  /// Patterns that the decoder keeps.
  [[nodiscard]] std::int32_t slots() const { return slots_; }
  [[nodiscard]] Coders& coders() { return coders_; }

  /// Seen state of a pattern that is a picture of the segment.
  [[nodiscard]] const State& seen_state(const Scene& scene, std::size_t time) const;
  /// Reduces the contrast of a picture as the scene's patterns have it. Ahead of coding.
  void reduce_contrast(const Scene& scene, std::size_t time, Picture& picture) const;
  [[nodiscard]] PatternSyntax pattern_syntax(std::size_t slot, std::size_t time,
                                             std::vector<std::uint8_t> av1) const;

  /// Sets the blend modes of all pictures.
  void set_modes(std::span<const RegionModes> modes);
  /// The modes of a group, as the encoder's next.
  /// @param begin  its first picture
  [[nodiscard]] BlendGroup blend_group(const BlendEncoder& encoder, std::size_t begin,
                                       std::size_t pictures) const;

 private:
  VideoFormat format_;
  CodedState rest_;
  int groups_per_key_;
  std::int32_t slots_;
  std::int32_t picture_ = 0;  ///< number of the segment's first
  Segment segment_;
  std::size_t timed_ = 0;    ///< pictures of the segment whose durations are not nominal
  std::uint64_t ticks_ = 0;  ///< that they last, 1/90000 s
  bool cut_ = false;
  Coders coders_;
};

/// What packets take in the stream, bytes.
[[nodiscard]] std::size_t bytes_of(std::span<const TypedPayload> packets);

}  // namespace fbs
