// Finds the mesh triangle that each node lies in. SPEC 10.3. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "decoder/field/node_grid.h"
#include "decoder/head/head_mesh.h"

namespace fbs {

inline constexpr int kCornerShareOneLog2 = 14;

/// The place of a node in its triangle.
struct NodePlace {
  MeshTriangle corner{};  ///< points of the mesh; corner[0] < 0: no triangle covers the node
  /// Shares of corners 1 and 2, in 2^-kCornerShareOneLog2; corner 0 has the rest.
  std::array<std::int32_t, 2> share{};

  [[nodiscard]] bool is_covered() const { return corner[0] >= 0; }

  /// The value at the node of a quantity linear over the triangle.
  [[nodiscard]] std::int32_t mean(std::int32_t v0, std::int32_t v1, std::int32_t v2) const {
    constexpr std::int64_t kHalf = std::int64_t{1} << (kCornerShareOneLog2 - 1);
    const std::int64_t more = (std::int64_t{v1} - v0) * share[0] + (std::int64_t{v2} - v0) * share[1];
    return v0 + static_cast<std::int32_t>((more + kHalf) >> kCornerShareOneLog2);
  }
};

/// The places of all nodes of a grid.
class NodeCover {
 public:
  /// Finds the last triangle that covers each node.
  /// @param triangles  in drawing order
  /// @param points     of the mesh, 1/64 luma sample
  void find(const NodeGrid& grid, std::span<const MeshTriangle> triangles,
            std::span<const glm::ivec2> points);

  /// Places each node that no triangle covers at the nearest point, the first of several.
  void take_nearest(std::span<const glm::ivec2> points);

  [[nodiscard]] const NodeGrid& grid() const { return grid_; }
  [[nodiscard]] const std::vector<NodePlace>& places() const { return places_; }

 private:
  void cover(std::int32_t triangle, const std::array<glm::ivec2, 3>& at);

  NodeGrid grid_;
  std::vector<NodePlace> places_;
  std::vector<std::int32_t> owner_;  ///< triangle of each node; -1: none
};

}  // namespace fbs
