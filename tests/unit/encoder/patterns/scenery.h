// Pictures for the coders of patterns.
#pragma once

#include <cmath>

#include "common/picture.h"

namespace fbs {

inline VideoFormat format_of(int width, int height) {
  VideoFormat f;
  f.width = width;
  f.height = height;
  return f;
}

/// Shading, an edge and some colour, at `time`.
inline Picture scenery(int width, int height, int time = 0) {
  Picture p(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double wave = 40 * std::sin((x + time) * 0.11) + 30 * std::cos(y * 0.07 + x * 0.03);
      p.y.row(y)[x] = static_cast<std::uint8_t>(120 + wave + (x + time > width / 2 ? 25 : 0));
    }
  for (int y = 0; y < p.u.height; ++y)
    for (int x = 0; x < p.u.width; ++x) {
      p.u.row(y)[x] = static_cast<std::uint8_t>(110 + 20 * std::sin(x * 0.1));
      p.v.row(y)[x] = static_cast<std::uint8_t>(140 + 20 * std::cos(y * 0.1));
    }
  return p;
}

}  // namespace fbs
