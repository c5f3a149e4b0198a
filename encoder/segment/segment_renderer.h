// Draws the pictures of a segment as the decoder will.
#pragma once

#include <vector>

#include "decoder/draw/renderer.h"
#include "encoder/segment/segment_blend.h"

namespace fbs {

class SegmentRenderer {
 public:
  /// @param patterns  must outlive the object
  explicit SegmentRenderer(const SegmentPatterns& patterns);

  /// Selects the group of the pictures in the next calls.
  void begin_group(std::size_t group);

  /// Draws an area of the picture's luma; the rest is undefined.
  /// @param state  blend modes included
  /// @return valid until the next call
  [[nodiscard]] Result<const Plane*> draw(const State& state, const SampleArea& area);

  /// Opacity of the state's mouth interior in the picture from draw(), mean over the mouth's sources, 0..1.
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
