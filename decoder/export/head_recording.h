// The heads of a stream, gathered picture by picture, for models with animation.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "common/state.h"
#include "decoder/scene/scene.h"

namespace fbs {

/// The state of a head at the time of a picture.
struct RecordedState {
  std::uint64_t time = 0;  ///< 1/90000 s from the first picture of the recording
  State state;
};

/// A person, or the same person whose head was measured again.
struct RecordedHead {
  Geometry geometry;
  Picture pattern;                    ///< the first that shows it
  State seen;                         ///< of `pattern`
  MouthInterior mouth;                ///< colours between parted lips
  std::vector<RecordedState> states;  ///< times ascend; at least one
};

/// A period in which one head, or none, is shown.
struct ShownHead {
  static constexpr std::size_t kNone = SIZE_MAX;
  std::uint64_t begin = 0;   ///< as RecordedState::time; until the next begins, or the end
  std::size_t head = kNone;  ///< index into HeadRecording::heads()
};

/// Scenes with equal heads, as after a key interval or a cut within a conversation, share one head, which
/// keeps its first pattern.
class HeadRecording {
 public:
  /// Adds a picture.
  /// @param time      1/90000 s, above the one before
  /// @param duration  1/90000 s
  void add(const Scene& scene, const State& state, std::uint64_t time, std::uint32_t duration);

  /// Heads in order of appearance; empty if no scene has a face.
  [[nodiscard]] const std::vector<RecordedHead>& heads() const { return heads_; }
  /// Which head is shown when, from time 0 on; neighbours differ.
  [[nodiscard]] const std::vector<ShownHead>& shown() const { return shown_; }
  /// Times of all pictures, 1/90000 s from the first one.
  [[nodiscard]] const std::vector<std::uint64_t>& times() const { return times_; }
  /// 1/90000 s, from the first picture to the end of the last one.
  [[nodiscard]] std::uint64_t duration() const { return end_ - first_; }
  /// Pixels per eye distance of the first head in its first state: sets the size of models. Not without
  /// heads.
  [[nodiscard]] double first_scale() const;
  /// Format of the first picture.
  [[nodiscard]] const VideoFormat& format() const { return format_; }

 private:
  std::size_t head_of(const Scene& scene);

  VideoFormat format_;
  std::vector<RecordedHead> heads_;
  std::vector<ShownHead> shown_;
  std::vector<std::uint64_t> times_;
  std::uint64_t first_ = 0, end_ = 0;  ///< stream time
};

}  // namespace fbs
