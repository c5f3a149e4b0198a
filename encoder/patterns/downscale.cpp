#include "encoder/patterns/downscale.h"

#include <algorithm>

namespace fbs {

Plane downscaled(const Plane& full) {
  Plane out((full.width + 1) / 2, (full.height + 1) / 2);
  for (int y = 0; y < out.height; ++y) {
    const std::uint8_t* top = full.row(2 * y);
    const std::uint8_t* bottom = full.row(std::min(2 * y + 1, full.height - 1));
    for (int x = 0; x < out.width; ++x) {
      const int left = 2 * x, right = std::min(2 * x + 1, full.width - 1);
      out.row(y)[x] =
          static_cast<std::uint8_t>((top[left] + top[right] + bottom[left] + bottom[right] + 2) / 4);
    }
  }
  return out;
}

Picture downscaled(const Picture& full) {
  Picture out;
  out.y = downscaled(full.y);
  out.u = downscaled(full.u);
  out.v = downscaled(full.v);
  return out;
}

}  // namespace fbs
