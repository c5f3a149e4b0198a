// Weight of each source at each node. SPEC 11.5. Integers only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decoder/field/node_cover.h"
#include "decoder/field/point_weights.h"
#include "decoder/field/source_rows.h"

namespace fbs {

inline constexpr std::int32_t kNodeWeightOne = kBlendOne;

/// Steps of the weights between those of the points, log2 in 1/kNodeWeightOne. Sixteenths save a sixth of the
/// sources that a block of the surround shows, for .005 dB; in the face they would take 1 % more bytes.
inline constexpr int kSurroundStepLog2 = 4, kAtlasStepLog2 = 0;

/// Weights of the sources at the nodes, in 1/kNodeWeightOne. A node's weights are contiguous.
class NodeWeights {
 public:
  /// @param corners  weights at the points of the mesh
  /// @param outside  weights at nodes that no triangle covers, in 1/kNodeWeightOne
  void set(const NodeCover& cover, const PointWeights& corners, std::span<const std::int32_t> outside,
           int step_log2 = kSurroundStepLog2);
  /// The same weights at all nodes.
  void set(const NodeGrid& grid, std::span<const std::int32_t> weights);

  [[nodiscard]] std::size_t row() const { return row_; }  ///< from one node to the next
  /// The weights of all sources.
  [[nodiscard]] const std::uint16_t* at(std::size_t node) const { return weights_.data() + node * row_; }

 private:
  std::size_t row_ = 0;
  std::vector<std::uint16_t> weights_, outside_;
  std::vector<std::int32_t> corners_;  ///< rows, 1/kMeshWeightOne
};

}  // namespace fbs
