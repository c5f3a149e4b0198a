#include "decoder/raster/row_runs.h"

#include <cstddef>

namespace fbs {

void DepthPlane::reset(int w, int height, const SampleArea& within) {
  width = w;
  area = within;
  depth.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(height) + kReadBeyond);
  for (int y = area.y0; y < area.y1; ++y) std::fill(row(y) + area.x0, row(y) + area.x1, kNothingDrawn);
}

}  // namespace fbs
