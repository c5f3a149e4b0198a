// A few neighbouring samples of a row, painted together.
#pragma once

#include <array>
#include <cstddef>

#include "decoder/raster/lanes.h"
#include "decoder/raster/linear_row.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {

/// Planes of one scale: Y; U and V.
[[nodiscard]] constexpr std::size_t plane_count(PlaneScale scale) {
  return scale == PlaneScale::kLuma ? 1 : 2;
}

template <PlaneScale kScale>
struct RowBlock {
  int row, first;  ///< sample of the planes
  int count;       ///< 1..kLaneCount
  FromCorner at;   ///< position of the first sample

  /// A quantity of the triangle along the block.
  [[nodiscard]] LinearRow along(const Gradient& g) const {
    return {g.at(at, static_cast<int>(kScale)), g.dx};
  }
};

/// The samples of a block in each plane.
template <PlaneScale kScale>
using BlockSamples = std::array<Lanes, plane_count(kScale)>;

}  // namespace fbs
