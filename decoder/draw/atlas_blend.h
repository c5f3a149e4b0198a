// The head as all sources show it, blended in the atlas. SPEC 10.12 and 11.6. Integers only.
#pragma once

#include <array>
#include <vector>

#include "decoder/atlas/head_atlas.h"
#include "decoder/blend/head_weights.h"
#include "decoder/draw/drawing.h"
#include "decoder/field/displaced_samples.h"
#include "decoder/field/node_kernels.h"
#include "decoder/field/node_weights.h"

namespace fbs {

/// The texture of the head in one picture. Keeps scratch memory only.
class AtlasBlend {
 public:
  /// Draws the warped sources. Does nothing without them.
  void draw(const Drawing& drawing, const HeadWeights& weights, const AtlasLayout& layout);

  /// Y, U, V of the layout's size, until the next call of draw().
  [[nodiscard]] std::array<ConstPlaneView, 3> planes() const { return {blended_.y, blended_.u, blended_.v}; }

 private:
  void draw_block(const Drawing& drawing, const HeadWeights& weights, const NodeGrid& grid, glm::ivec2 block);

  NodeWeights nodes_;
  std::vector<BlendedSource> shown_;
  HeadAtlas blended_;
};

}  // namespace fbs
