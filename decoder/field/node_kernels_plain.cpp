#include "decoder/field/node_kernels_plain.h"

#include <algorithm>
#include <cstdint>

#include "decoder/field/node_weights.h"

namespace fbs::plain {
namespace {

/// The first row of a point.
const std::int32_t* row_of(const std::int32_t* rows, std::int32_t point, std::size_t size) {
  return rows + static_cast<std::size_t>(point) * size;
}

}  // namespace

void weigh_nodes(std::span<const NodePlace> places, const std::int32_t* corners, const std::uint16_t* outside,
                 std::size_t row, int step_log2, std::uint16_t* out) {
  for (const NodePlace& place : places) {
    if (place.is_covered()) {
      const std::int32_t *const a = row_of(corners, place.corner[0], row),
                                *const b = row_of(corners, place.corner[1], row),
                                *const c = row_of(corners, place.corner[2], row);
      const std::int32_t step = kMeshWeightOne / kNodeWeightOne << step_log2;
      std::int32_t sum = 0, before = 0;
      for (std::size_t s = 0; s < row; ++s) {
        sum += place.mean(a[s], b[s], c[s]);
        const std::int32_t rounded = (sum + step / 2) / step << step_log2;
        out[s] = static_cast<std::uint16_t>(rounded - before);
        before = rounded;
      }
    } else {
      std::copy_n(outside, row, out);
    }
    out += row;
  }
}

void displace_nodes(const NodeCover& cover, const std::int32_t* moved, const NodeLimits& limits,
                    std::size_t row, std::int32_t* out) {
  const NodePlace* place = cover.places().data();
  for (int j = 0; j < cover.grid().rows(); ++j) {
    for (int i = 0; i < cover.grid().columns(); ++i, ++place, out += 2 * row) {
      if (!place->is_covered()) {
        std::fill_n(out, 2 * row, 0);
        continue;
      }
      const std::int32_t *const a = row_of(moved, place->corner[0], 2 * row),
                                *const b = row_of(moved, place->corner[1], 2 * row),
                                *const c = row_of(moved, place->corner[2], 2 * row);
      const glm::ivec2 node(NodeGrid::place(i), NodeGrid::place(j)), low = limits.first - node,
                                                                     high = limits.last - node;
      for (std::size_t s = 0; s < row; ++s) {
        out[s] = std::clamp(place->mean(a[s], b[s], c[s]), low.x, high.x);
        out[row + s] = std::clamp(place->mean(a[row + s], b[row + s], c[row + s]), low.y, high.y);
      }
    }
  }
}

void find_motions(const BlockNodes& nodes, std::size_t first, BlockMotions& out) {
  out.shown = 0;
  out.whole.fill(kStill);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      for (std::size_t s = 0; s < kRowStep; ++s)
        if (nodes.weight_at(i, j)[first + s] != 0) out.shown |= 1U << s;
  if (nodes.displacement == nullptr) return;
  for (std::size_t s = 0; s < kRowStep; ++s) {
    const auto at = [&](int column, int line) {
      const std::int32_t* const d = nodes.displacement_at(column, line) + first + s;
      return glm::ivec2(d[0], d[nodes.row]);
    };
    // Kind of a square of `size` patches, by its nodes, and the mean of its corners.
    const auto find = [&](int column, int line, int size, std::int32_t& kind, std::int32_t& x,
                          std::int32_t& y) {
      glm::ivec2 least = at(column, line), most = least;
      for (int j = line; j <= line + size; ++j)
        for (int i = column; i <= column + size; ++i) {
          const glm::ivec2 d = at(i, j);
          least = {std::min(least.x, d.x), std::min(least.y, d.y)};
          most = {std::max(most.x, d.x), std::max(most.y, d.y)};
        }
      const bool is_still = least == glm::ivec2(0) && most == glm::ivec2(0),
                 is_bent = std::max(most.x - least.x, most.y - least.y) > kEvenEnough;
      kind = is_still ? kStill : is_bent ? kBent : kEven;
      const glm::ivec2 sum = at(column, line) + at(column + size, line) + at(column, line + size) +
                             at(column + size, line + size) + 2;
      x = sum.x >> 2;
      y = sum.y >> 2;
    };
    find(0, 0, 2, out.whole[s], out.whole_by[0][s], out.whole_by[1][s]);
    for (int patch = 0; patch < 4; ++patch)
      find(patch % 2, patch / 2, 1, out.kind[patch][s], out.by[patch][0][s], out.by[patch][1][s]);
  }
}

}  // namespace fbs::plain
