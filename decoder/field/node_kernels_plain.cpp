#include "decoder/field/node_kernels_plain.h"

#include <algorithm>

#include "decoder/field/node_weights.h"

namespace fbs::plain {
namespace {

/// The first row of a point.
const std::int32_t* row_of(const std::int32_t* rows, std::int32_t point, std::size_t size) {
  return rows + static_cast<std::size_t>(point) * size;
}

}  // namespace

void weigh_nodes(std::span<const NodePlace> places, const std::int32_t* corners, const std::uint16_t* outside,
                 std::size_t row, std::uint16_t* out) {
  for (const NodePlace& place : places) {
    if (place.is_covered()) {
      const std::int32_t *const a = row_of(corners, place.corner[0], row),
                                *const b = row_of(corners, place.corner[1], row),
                                *const c = row_of(corners, place.corner[2], row);
      std::int32_t left = kNodeWeightOne;
      for (std::size_t s = 0; s < row; ++s) {
        out[s] = static_cast<std::uint16_t>(place.mean(a[s], b[s], c[s]) / (kMeshWeightOne / kNodeWeightOne));
        left -= out[s];
      }
      std::uint16_t& largest = *std::max_element(out, out + row);
      largest = static_cast<std::uint16_t>(largest + left);
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
    bool all_still = true, all_even = true;
    for (int patch = 0; patch < 4; ++patch) {
      MotionKind kind = kStill;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto at = [&](int column, int line) {
          return nodes.displacement_at(patch % 2 + column, patch / 2 + line)[axis * nodes.row + first + s];
        };
        const std::int32_t d[] = {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
        const auto [least, most] = std::minmax_element(d, d + 4);
        if ((d[0] | d[1] | d[2] | d[3]) != 0)
          kind = std::max(kind, *most - *least > kEvenEnough ? kBent : kEven);
        out.by[patch][axis][s] = (d[0] + d[1] + d[2] + d[3] + 2) >> 2;
      }
      out.kind[patch][s] = kind;
      all_still &= kind == kStill;
      all_even &=
          kind == kEven && out.by[patch][0][s] == out.by[0][0][s] && out.by[patch][1][s] == out.by[0][1][s];
    }
    out.whole[s] = all_still ? kStill : all_even ? kEven : kBent;
  }
}

}  // namespace fbs::plain
