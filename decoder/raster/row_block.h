// A few neighbouring samples of a row, which are painted together.
#pragma once

#include "decoder/raster/lanes.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {

struct RowBlock {
  int row, first;  ///< sample of the plane
  int count;       ///< 1..kLaneCount
  FromCorner at;   ///< position of the first sample
};

}  // namespace fbs
