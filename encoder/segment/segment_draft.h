// Patterns of a segment in the making.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/workers.h"
#include "decoder/scene/scene.h"
#include "encoder/patterns/pattern_sequence.h"
#include "encoder/segment/segment_blend.h"
#include "encoder/segment/segment_store.h"

namespace fbs {

/// Bytes of a scene's first pattern and its picture besides frame and motion, about: packet headers, whole
/// state, modes.
inline constexpr double kPatternHeadBytes = 20;

struct SegmentDraft {
  std::vector<std::size_t> times;  ///< pictures of the segment that are patterns, rising
  std::vector<Picture> pictures;   ///< to be coded, in the order of times
  std::vector<SequencePattern> coded;
  /// The scene's first pattern, if it is a coarse one for the start: coded already, and the next one takes
  /// its slot. pictures[0] is its picture.
  std::optional<SequencePattern> start;
  bool alone = false;                ///< each pattern but the scene's first needs that one alone
  std::size_t first_slot = 0;        ///< of the first in coding order; the others follow, around the store
  std::vector<std::size_t> shown;    ///< picture of each pattern, in coding order
  std::vector<std::size_t> arrived;  ///< arrivals()
  PatternList patterns;              ///< those from before the segment, then those of the segment as coded

  /// A draft of source pictures, none of which is a pattern yet.
  [[nodiscard]] static Result<SegmentDraft> of_sources(const SegmentStore& store,
                                                       std::vector<std::size_t> times,
                                                       std::size_t first_slot);

  /// The pictures as patterns have them: of reduced contrast.
  [[nodiscard]] std::vector<Picture> to_code(const SegmentStore& store, const Scene& scene,
                                             Workers& workers) const;
  /// Codes the pictures, but for that of `start`, as an AV1 sequence of their own.
  Result<void> code(const SegmentStore& store, const Scene& scene, const SequenceSettings& coding,
                    Workers& workers);
  /// Takes the pictures as patterns, without loss and in display order.
  void take_sources(const SegmentStore& store, const Scene& scene);
  /// Takes the patterns as coded.
  void take(const SegmentStore& store, const Scene& scene, std::vector<SequencePattern> patterns_coded);
  /// Makes the patterns again, seen in the present states of their pictures.
  void place(const SegmentStore& store, const Scene& scene);

  [[nodiscard]] SegmentPatterns usable(const Scene& scene) const;
  /// Replaces the pictures by those that draw the segment best in its present modes.
  Result<void> solve(const SegmentStore& store, const Scene& scene, const SolverSettings& settings,
                     Workers& workers);

  /// The segment's packets in stream order.
  [[nodiscard]] Result<std::vector<TypedPayload>> packets(const SegmentStore& store, const Setup& setup,
                                                          SegmentStore::Coders& coders) const;
  /// Puts the patterns into the scene, as the decoder has them after the segment.
  void keep(const SegmentStore& store, Scene& scene) const;

  /// The slot of a pattern in coding order or, behind the last, of the one that follows.
  /// @param slots  of the store
  [[nodiscard]] std::size_t slot(std::size_t k, std::size_t slots) const {
    return (first_slot + k - (start && k > 0 ? 1 : 0)) % slots;
  }
};

}  // namespace fbs
