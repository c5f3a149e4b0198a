// Draws the surround of the face, or the whole picture in a scene without one: patches of all sources,
// blended. SPEC 10.3 and 11.6.
#pragma once

#include <array>
#include <vector>

#include "decoder/draw/drawing.h"
#include "decoder/field/displaced_samples.h"
#include "decoder/field/node_kernels.h"
#include "decoder/field/node_weights.h"
#include "decoder/field/surround_field.h"
#include "decoder/raster/row_runs.h"

namespace fbs {

/// The surround of one picture. `field` and `weights` belong to the drawing's sources.
struct SurroundDrawing {
  const Drawing& drawing;
  const NodeGrid& grid;
  const SurroundField& field;
  const NodeWeights& weights;
  /// What the head covers is left as it is. Luma and chroma; null: nothing is covered
  std::array<const DepthPlane*, 2> head{};
};

/// Keeps scratch memory only.
class SurroundPainter {
 public:
  /// Draws the blocks that have samples in the drawing's areas.
  void draw(const SurroundDrawing& surround);

 private:
  void draw_block(const SurroundDrawing& surround, glm::ivec2 block);

  void draw_sources(const SurroundDrawing& surround, glm::ivec2 block);

  std::vector<BlendedSource> blended_;  ///< of a block
  std::vector<BlockMemory> memory_;     ///< of each of blended_
};

}  // namespace fbs
