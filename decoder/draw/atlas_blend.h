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

/// The texture of the head in one picture. Keeps nothing between pictures.
class AtlasBlend {
 public:
  /// Prepares for a picture.
  void begin(const HeadWeights& weights, const AtlasLayout& layout);

  /// Draws the warped sources in the blocks of some rows; several threads may do so at once. Does nothing
  /// without warped sources.
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
