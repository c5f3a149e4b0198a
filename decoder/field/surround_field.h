// Displacement of the sources' textures at each node. SPEC 10.3. Integers only.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "decoder/field/node_cover.h"
#include "decoder/field/source_rows.h"

namespace fbs {

/// The displacements of all sources at all nodes, 1/64 luma sample.
class SurroundField {
 public:
  /// @param seen  the grid points in each source's pattern, 1/64 luma sample; null: the source does not move
  /// @param now   the grid points in the picture
  /// @param size  of the picture, luma samples
  void set(const NodeCover& cover, std::span<const std::vector<glm::ivec2>* const> seen,
           std::span<const glm::ivec2> now, glm::ivec2 size);

  /// Sets all sources to no motion.
  void set_still() { row_ = 0; }
  [[nodiscard]] bool moves() const { return row_ != 0; }

  [[nodiscard]] std::size_t row() const { return row_; }
  /// The x displacements of all sources, followed by the y displacements. Only if it moves.
  [[nodiscard]] const std::int32_t* at(std::size_t node) const {
    return displacement_.data() + node * 2 * row_;
  }
  [[nodiscard]] glm::ivec2 at(std::size_t node, std::size_t source) const {
    return moves() ? glm::ivec2(at(node)[source], at(node)[row_ + source]) : glm::ivec2(0);
  }

 private:
  std::size_t row_ = 0;
  std::vector<std::int32_t> moved_;  ///< of the grid's points, in rows like displacement_
  std::vector<std::int32_t> displacement_;
};

}  // namespace fbs
