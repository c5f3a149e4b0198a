// Draws what is round the face, and in scenes without one the picture: patches of all sources, blended.
// SPEC 10.3 and 11.6.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "decoder/draw/drawing.h"
#include "decoder/field/patch_kernels.h"
#include "decoder/field/patch_motion.h"
#include "decoder/field/surround_field.h"

namespace fbs {

/// Of one picture. `fields` and `weights` are those of the drawing's sources.
struct SurroundDrawing {
  const Drawing& drawing;
  const NodeGrid& grid;
  const std::vector<SourceField>& fields;
  const NodeWeights& weights;
};

/// Keeps scratch memory only.
class SurroundPainter {
 public:
  /// Draws all blocks that have samples in the drawing's areas.
  void draw(const SurroundDrawing& surround);

 private:
  /// A source that shows in a block.
  struct Shown {
    const DrawnSource* source;
    std::array<std::uint16_t, 9> weight;
    BlockMotion motion;
    std::array<WarpedBlock, 3> memory;  ///< what it shows in each plane, if that has to be drawn
  };

  void draw_block(const SurroundDrawing& surround, glm::ivec2 block);
  void collect(const SurroundDrawing& surround, glm::ivec2 block);
  void show(std::size_t plane, const Shown& shown, const SampleBlock& block);
  void show_patches(Shown& shown, glm::ivec2 block, bool has_chroma);
  void blend(std::size_t plane, glm::ivec2 block, const PlaneView& target);

  std::vector<Shown> shown_;  ///< the first `count_`; the others are memory
  std::size_t count_ = 0;
  std::array<std::vector<BlendedSource>, 3> blended_;  ///< of each plane
};

}  // namespace fbs
