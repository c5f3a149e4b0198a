#include "decoder/draw/atlas_blend.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "common/generic_head.h"

namespace fbs {
namespace {

/// At each point of the skirt the weights are those of the ring's.
PointWeights with_skirt(const PointWeights& head) {
  PointWeights out = head;
  const auto ring = static_cast<std::ptrdiff_t>(kVertexCount * head.sources);
  out.weights.insert(out.weights.end(), head.weights.begin() + ring, head.weights.end());
  return out;
}

/// What an atlas shows in a block.
BlockSamples3 block_of(const HeadAtlas& atlas, glm::ivec2 block) {
  const std::array<const Plane*, 3> planes{&atlas.y, &atlas.u, &atlas.v};
  BlockSamples3 out{};
  for (std::size_t p = 0; p < 3; ++p) {
    const glm::ivec2 first = block * (p == 0 ? kBlockSize : kChromaBlockSize);
    out[p] = {planes[p]->row(first.y) + first.x, planes[p]->width};
  }
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
  const auto node = static_cast<std::size_t>(2 * block.y * grid.columns() + 2 * block.x);
  const BlockNodes nodes{nodes_.at(node), nullptr, nodes_.row(), grid.columns()};
  BlockMotions motions;
  shown_.clear();
  for (std::size_t first = 0; first < nodes.row; first += kRowStep) {
    find_motions(nodes, first, motions);
    for (std::uint32_t left = motions.shown; left != 0; left &= left - 1) {
      const std::size_t k = first + static_cast<std::size_t>(std::countr_zero(left));
      shown_.push_back({block_of(*drawing.sources[weights.warped[k]].atlas, block), nodes.weight + k});
    }
  }
  const auto step = static_cast<std::ptrdiff_t>(nodes.row);
  const std::array<PlaneView, 3> target = drawing.chroma_area.empty()
                                              ? std::array<PlaneView, 3>{blended_.y, {}, {}}
                                              : std::array<PlaneView, 3>{blended_.y, blended_.u, blended_.v};
  draw_blend(shown_, {step, grid.columns() * step}, block, target);
}

}  // namespace fbs
