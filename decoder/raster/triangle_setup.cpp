#include "decoder/raster/triangle_setup.h"

namespace fbs {

bool faces_viewer(const ScreenTriangle& t) {
  const std::int64_t ax = t[1].at.x - t[0].at.x, ay = t[1].at.y - t[0].at.y;
  const std::int64_t bx = t[2].at.x - t[0].at.x, by = t[2].at.y - t[0].at.y;
  return ax * by - ay * bx > 0;
}

}  // namespace fbs
