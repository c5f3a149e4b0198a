// A surround as the tests of its fields have it.
#pragma once

#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "decoder/field/node_cover.h"
#include "tests/unit/toy_scene.h"

namespace fbs {

/// A grid of 8 x 8 cells in a toy scene, in some state.
struct SurroundGrid {
  static constexpr int kWidth = 160, kHeight = 128;

  SurroundMap map = even_surround(8, 8, 0);
  Surround surround{toy_setup(kWidth, kHeight).format, map, toy_state()};
  std::vector<glm::ivec2> now = at(toy_state());
  NodeCover cover;

  explicit SurroundGrid(SurroundMap m = even_surround(8, 8, 0)) : map(std::move(m)) { find(); }
  [[nodiscard]] std::vector<glm::ivec2> at(const State& state) const {
    std::vector<glm::ivec2> out;
    surround.project(state, out);
    return out;
  }
  void find() { cover.find(NodeGrid(kWidth, kHeight), surround.triangles(), now); }
};

}  // namespace fbs
