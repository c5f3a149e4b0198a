// Draws the pictures of a segment as the decoder will.
#pragma once

#include <vector>

#include "decoder/draw/renderer.h"
#include "encoder/segment/segment_blend.h"

namespace fbs {

/// Keeps a copy of the patterns that one group is drawn from.
class SegmentRenderer {
 public:
  /// @param patterns  must outlive the object
  explicit SegmentRenderer(const SegmentPatterns& patterns);

  /// The next calls are about pictures of this group.
  void begin_group(std::size_t group);

  /// Draws an area of the picture's luma; what lies outside is undefined.
  /// @param state  blend modes included
  /// @return valid until the next call
  [[nodiscard]] Result<const Plane*> draw(const State& state, const SampleArea& area);

  /// Of the state's mouth interior in what draw() shows, mean over what the mouth is blended from, 0..1.
  [[nodiscard]] double interior_opacity(const State& state) const;

 private:
  const SegmentPatterns& patterns_;
  std::vector<std::int32_t> mouth_gaps_;  ///< of each pattern as seen, head units
  AvailablePatterns slots_;               ///< which pattern each of scene_ is
  Scene scene_;
  Renderer renderer_;
  Plane luma_;
};

}  // namespace fbs
