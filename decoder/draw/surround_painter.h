// Draws the picture round the face. SPEC 10.3, 10.4.
#pragma once

#include <array>

#include "decoder/animate/surround.h"
#include "decoder/draw/drawing.h"
#include "decoder/draw/triangle_sources.h"

namespace fbs {

/// Draws cells of the surround's grid over the base picture.
class SurroundPainter {
 public:
  explicit SurroundPainter(const Drawing& drawing) : d_(drawing) {}

  /// Draws both halves of the cell, unless it would look as the base picture does.
  void draw(const Surround::Cell& cell);

 private:
  [[nodiscard]] bool is_ground_at_rest(const Surround::Cell& cell) const;
  void draw_half(const std::array<int, 3>& points);

  const Drawing& d_;
  TriangleSources sources_;
};

}  // namespace fbs
