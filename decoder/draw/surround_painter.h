// Draws what is round the face, and in scenes without one the picture: patches of all sources, blended.
// SPEC 10.3 and 11.6.
#pragma once

#include <vector>

#include "decoder/draw/drawing.h"
#include "decoder/field/displaced_samples.h"
#include "decoder/field/node_kernels.h"
#include "decoder/field/node_weights.h"
#include "decoder/field/surround_field.h"

namespace fbs {

/// Of one picture. `field` and `weights` are those of the drawing's sources.
struct SurroundDrawing {
  const Drawing& drawing;
  const NodeGrid& grid;
  const SurroundField& field;
  const NodeWeights& weights;
};

/// Keeps scratch memory only.
class SurroundPainter {
 public:
  /// Draws all blocks that have samples in the drawing's areas.
  void draw(const SurroundDrawing& surround);

 private:
  void draw_block(const SurroundDrawing& surround, glm::ivec2 block);

  std::vector<BlendedSource> blended_;  ///< of a block
  std::vector<BlockMemory> memory_;     ///< of each of them
};

}  // namespace fbs
