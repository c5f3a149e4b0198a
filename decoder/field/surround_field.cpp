#include "decoder/field/surround_field.h"

#include <algorithm>
#include <utility>

#include "decoder/field/padded_plane.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

/// Weights of the sources at a node, 1/kMeshWeightOne, rounded to 1/kNodeWeightOne. The largest takes what
/// rounding leaves.
template <class Weight>
void round_weights(std::size_t sources, Weight&& weight, std::uint16_t* out, std::size_t stride) {
  std::int32_t left = kNodeWeightOne;
  std::size_t largest = 0;
  for (std::size_t s = 0; s < sources; ++s) {
    const auto rounded = static_cast<std::uint16_t>(weight(s) / (kMeshWeightOne / kNodeWeightOne));
    out[s * stride] = rounded;
    left -= rounded;
    if (rounded > out[largest * stride]) largest = s;
  }
  out[largest * stride] = static_cast<std::uint16_t>(out[largest * stride] + left);
}

}  // namespace

void displace(const NodeCover& cover, std::span<const glm::ivec2> seen, std::span<const glm::ivec2> now,
              int width, int height, SourceField& out) {
  out.moves = !std::equal(seen.begin(), seen.end(), now.begin(), now.end());
  if (!out.moves) return;
  std::vector<glm::ivec2> moved;
  moved.reserve(seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k) moved.push_back(seen[k] - now[k]);
  constexpr int kOutside = kMaxOutside << kScreenOneLog2;
  const glm::ivec2 end(width << kScreenOneLog2, height << kScreenOneLog2);
  const NodeGrid& grid = cover.grid();
  out.displacement.resize(grid.size());
  for (int j = 0, k = 0; j < grid.rows(); ++j) {
    const int y = NodeGrid::place(j);
    for (int i = 0; i < grid.columns(); ++i, ++k) {
      const NodePlace& place = cover.places()[k];
      glm::ivec2& d = out.displacement[k];
      d = {};
      if (!place.is_covered()) continue;
      const glm::ivec2 a = moved[place.corner[0]], b = moved[place.corner[1]], c = moved[place.corner[2]];
      const int x = NodeGrid::place(i);
      if ((a.x | b.x | c.x) != 0)
        d.x = std::clamp(place.mean(a.x, b.x, c.x), -kOutside - x, end.x + kOutside - x);
      if ((a.y | b.y | c.y) != 0)
        d.y = std::clamp(place.mean(a.y, b.y, c.y), -kOutside - y, end.y + kOutside - y);
    }
  }
}

void NodeWeights::set(const NodeCover& cover, const PointWeights& corners,
                      std::span<const std::int32_t> outside) {
  nodes_ = cover.places().size();
  weights_.resize(nodes_ * corners.sources);
  for (std::size_t k = 0; k < nodes_; ++k) {
    const NodePlace& place = cover.places()[k];
    if (!place.is_covered()) {
      for (std::size_t s = 0; s < corners.sources; ++s)
        weights_[s * nodes_ + k] = static_cast<std::uint16_t>(outside[s]);
      continue;
    }
    const std::int32_t *const a = corners.at(place.corner[0]).data(),
                              *const b = corners.at(place.corner[1]).data(),
                              *const c = corners.at(place.corner[2]).data();
    round_weights(
        corners.sources, [&](std::size_t s) { return place.mean(a[s], b[s], c[s]); }, &weights_[k], nodes_);
  }
}

BlockWeights NodeWeights::of_block(std::size_t source, const NodeGrid& grid, glm::ivec2 block) const {
  const int columns = grid.columns();
  const std::uint16_t* node = of(source) + std::ptrdiff_t{2} * block.y * columns + 2 * block.x;
  BlockWeights out{};
  unsigned any = 0;
  for (std::size_t row = 0; row < 3; ++row, node += columns)
    for (std::size_t i = 0; i < 3; ++i) any |= out.at[3 * row + i] = node[i];
  out.any = any != 0;
  return out;
}

void NodeWeights::set(const NodeGrid& grid, std::span<const std::int32_t> weights) {
  nodes_ = grid.size();
  weights_.clear();
  for (const std::int32_t w : weights) weights_.insert(weights_.end(), nodes_, static_cast<std::uint16_t>(w));
}

}  // namespace fbs
