#include "decoder/field/node_weights.h"

#include <algorithm>

#include "decoder/field/node_kernels.h"

namespace fbs {

void NodeWeights::set(const NodeCover& cover, const PointWeights& corners,
                      std::span<const std::int32_t> outside, int step_log2) {
  row_ = row_size(corners.sources);
  outside_.assign(row_, 0);
  std::copy(outside.begin(), outside.end(), outside_.begin());
  const std::size_t points = corners.sources == 0 ? 0 : corners.weights.size() / corners.sources;
  corners_.assign(points * row_, 0);
  for (std::size_t p = 0; p < points; ++p)
    std::copy_n(corners.at(p).data(), corners.sources, corners_.data() + p * row_);
  weights_.resize(cover.places().size() * row_);
  weigh_nodes(cover.places(), corners_.data(), outside_.data(), row_, step_log2, weights_.data());
}

void NodeWeights::set(const NodeGrid& grid, std::span<const std::int32_t> weights) {
  row_ = row_size(weights.size());
  weights_.assign(grid.size() * row_, 0);
  for (std::size_t node = 0; node < grid.size(); ++node)
    std::copy(weights.begin(), weights.end(), weights_.begin() + static_cast<std::ptrdiff_t>(node * row_));
}

}  // namespace fbs
