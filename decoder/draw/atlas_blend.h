// What all sources show of the head, blended in the atlas. SPEC 10.12 and 11.6. Integers only.
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

/// The texture of the head of one picture. Keeps nothing of the picture before.
class AtlasBlend {
 public:
  /// Makes ready for a picture.
  void begin(const HeadWeights& weights, const AtlasLayout& layout);

  /// Draws what the warped sources show in the blocks of some rows, which may be done by several threads at
  /// once. Nothing if there are no such sources.
  /// @param first, last  rows of blocks, the last one not included
  /// @param scratch      memory of the thread
  void draw_rows(const Drawing& drawing, int first, int last, std::vector<BlendedSource>& scratch);

  /// Y, U, V of the layout's size, until the next call of begin().
  [[nodiscard]] std::array<ConstPlaneView, 3> planes() const { return {blended_.y, blended_.u, blended_.v}; }

 private:
  void blend(const Drawing& drawing, glm::ivec2 block, std::vector<BlendedSource>& shown);

  const HeadWeights* weights_ = nullptr;
  const AtlasLayout* layout_ = nullptr;
  NodeWeights nodes_;
  HeadAtlas blended_;
};

}  // namespace fbs
