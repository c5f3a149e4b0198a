#include "decoder/draw/atlas_blend.h"

#include <array>
#include <cstddef>

namespace fbs {
namespace {

/// Points of the skirt take the weights of the ring's.
PointWeights with_skirt(const PointWeights& head, std::size_t head_count) {
  PointWeights out = head;
  const auto ring = static_cast<std::ptrdiff_t>(head_count * head.sources);
  out.weights.insert(out.weights.end(), head.weights.begin() + ring, head.weights.end());
  return out;
}

/// The samples of an atlas in a block.
BlockSamples3 block_of(const HeadAtlas& atlas, glm::ivec2 block) {
  const std::array<const Plane*, 3> planes{&atlas.y, &atlas.u, &atlas.v};
  BlockSamples3 out{};
  for (std::size_t p = 0; p < 3; ++p) {
    const glm::ivec2 first = block * block_size(p);
    out[p] = {planes[p]->row(first.y) + first.x, planes[p]->width};
  }
  return out;
}

}  // namespace

void AtlasBlend::draw(const Drawing& drawing, const HeadWeights& weights, const AtlasLayout& layout) {
  if (weights.warped.empty()) return;
  if (blended_.width() != layout.width || blended_.height() != layout.height)
    blended_ = HeadAtlas(layout.width, layout.height);
  nodes_.set(layout.cover, with_skirt(weights.atlas, layout.head_count), {}, kAtlasStepLog2);
  for (const glm::ivec2 block : layout.blocks) draw_block(drawing, weights, layout.cover.grid(), block);
}

void AtlasBlend::draw_block(const Drawing& drawing, const HeadWeights& weights, const NodeGrid& grid,
                            glm::ivec2 block) {
  const std::size_t node = grid.first_of_block(block.x, block.y);
  const BlockNodes nodes{nodes_.at(node), nullptr, nodes_.row(), grid.columns()};
  shown_.clear();
  for_each_shown(nodes, [&](std::size_t first, std::size_t place, const BlockMotions&) {
    const HeadAtlas& atlas = *drawing.sources[weights.warped[first + place]].atlas;
    shown_.push_back({block_of(atlas, block), nodes.weight + first + place});
  });
  const auto step = static_cast<std::ptrdiff_t>(nodes.row);
  const std::array<PlaneView, 3> target = drawing.chroma_area.empty()
                                              ? std::array<PlaneView, 3>{blended_.y, {}, {}}
                                              : std::array<PlaneView, 3>{blended_.y, blended_.u, blended_.v};
  draw_blend(shown_, {step, grid.columns() * step}, block, target);
}

}  // namespace fbs
