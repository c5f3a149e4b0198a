#include "decoder/raster/row_runs.h"

#include <cstddef>

namespace fbs {

void DepthPlane::reset(int w, int height, const SampleArea& within) {
  width = w;
  area = within;
  depth.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(height) + kReadBeyond);
  for (int y = area.y0; y < area.y1; ++y)
    std::fill(row(y) + area.x0, row(y) + area.x1, std::numeric_limits<std::int32_t>::max());
}

int DepthPlane::covered(const SampleArea& part) const {
  constexpr int kTogether = 8;  // for vectors
  int out = 0;
  for (int y = part.y0; y < part.y1; ++y) {
    const std::int32_t* const at = row(y);
    int x = part.x0;
    for (; x + kTogether <= part.x1; x += kTogether)
      for (int k = 0; k < kTogether; ++k) out += is_covered(at[x + k]) ? 1 : 0;
    for (; x < part.x1; ++x) out += is_covered(at[x]) ? 1 : 0;
  }
  return out;
}

}  // namespace fbs
