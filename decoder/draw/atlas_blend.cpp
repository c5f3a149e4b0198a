#include "decoder/draw/atlas_blend.h"

namespace fbs {
namespace {

/// At each point of the skirt the weights are those of the ring's.
PointWeights with_skirt(const PointWeights& head) {
  PointWeights out = head;
  const auto ring = static_cast<std::ptrdiff_t>(kVertexCount * head.sources);
  out.weights.insert(out.weights.end(), head.weights.begin() + ring, head.weights.end());
  return out;
}

}  // namespace

void AtlasBlend::draw(const Drawing& drawing, const HeadWeights& weights, const AtlasLayout& layout) {
  if (weights.warped.empty()) return;
  if (blended_.width() != layout.width || blended_.height() != layout.height)
    blended_ = HeadAtlas(layout.width, layout.height);
  nodes_.set(layout.cover, with_skirt(weights.atlas), {});
  for (const glm::ivec2 block : layout.blocks) blend(drawing, weights, layout.cover.grid(), block);
}

void AtlasBlend::blend(const Drawing& drawing, const HeadWeights& weights, const NodeGrid& grid,
                       glm::ivec2 block) {
  const std::array<PlaneView, 3> planes{blended_.y, blended_.u, blended_.v};
  const std::size_t count = drawing.chroma_area.empty() ? 1 : 3;
  std::array<std::ptrdiff_t, 3> first{};
  for (std::size_t p = 0; p < count; ++p) {
    const int size = p == 0 ? kBlockSize : kChromaBlockSize;
    first[p] = std::ptrdiff_t{block.y} * size * planes[p].stride + std::ptrdiff_t{block.x} * size;
    shown_[p].clear();
  }
  for (std::size_t k = 0; k < weights.warped.size(); ++k) {
    const BlockWeights at = nodes_.of_block(k, grid, block);
    if (!at.any) continue;
    const HeadAtlas& atlas = *drawing.sources[weights.warped[k]].atlas;
    const std::array<const Plane*, 3> from{&atlas.y, &atlas.u, &atlas.v};
    for (std::size_t p = 0; p < count; ++p)
      shown_[p].push_back({{from[p]->samples.data() + first[p], planes[p].stride}, at.at});
  }
  for (std::size_t p = 0; p < count; ++p) {
    const int size = p == 0 ? kBlockSize : kChromaBlockSize;
    draw_blend(p, shown_[p], {size, size}, planes[p].data + first[p], planes[p].stride);
  }
}

}  // namespace fbs
