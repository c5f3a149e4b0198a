// What the patches of the surround show: displacements and weights of the sources at their corners.
// SPEC 10.3, 11.1 and 11.5. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "decoder/blend/mesh_blend.h"
#include "decoder/field/node_cover.h"

namespace fbs {

/// How far the texture lies from the picture at each node, 1/64 luma sample, row by row.
struct SourceField {
  bool moves = false;                    ///< false: all displacements are zero
  std::vector<glm::ivec2> displacement;  ///< undefined if it does not move
};

/// @param seen, now  the grid points where the pattern saw them and in the picture, 1/64 luma sample
/// @param width, height  of the picture
void displace(const NodeCover& cover, std::span<const glm::ivec2> seen, std::span<const glm::ivec2> now,
              int width, int height, SourceField& out);

inline constexpr std::int32_t kNodeWeightOne = kBlendOne;

/// The weights of a source in a block.
struct BlockWeights {
  std::array<std::uint16_t, 9> at;  ///< nodes, row by row
  bool any;                         ///< whether some are not zero
};

/// Weights of the sources at the nodes, in 1/kNodeWeightOne. Those of one source lie together, row by row.
class NodeWeights {
 public:
  /// @param corners  weights at the points of the mesh
  /// @param outside  those of nodes that no triangle covers, in 1/kNodeWeightOne
  void set(const NodeCover& cover, const PointWeights& corners, std::span<const std::int32_t> outside);
  /// The same weights at all nodes.
  void set(const NodeGrid& grid, std::span<const std::int32_t> weights);

  [[nodiscard]] const std::uint16_t* of(std::size_t source) const {
    return weights_.data() + source * nodes_;
  }
  /// @param block  its column and row
  [[nodiscard]] BlockWeights of_block(std::size_t source, const NodeGrid& grid, glm::ivec2 block) const;

 private:
  std::size_t nodes_ = 0;
  std::vector<std::uint16_t> weights_;
};

}  // namespace fbs
