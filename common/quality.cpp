#include "common/quality.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fbs {
double SquaredError::psnr() const {
  if (count == 0) return 0;
  if (sum == 0) return 99;
  return std::min(99.0,
                  10 * std::log10(255.0 * 255.0 * static_cast<double>(count) / static_cast<double>(sum)));
}

SquaredError squared_error(const Plane& a, const Plane& b) {
  assert(a.width == b.width && a.height == b.height);
  SquaredError e;
  e.count = a.samples.size();
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const int d = a.samples[i] - b.samples[i];
    e.sum += static_cast<std::uint64_t>(d * d);
  }
  return e;
}

SquaredError squared_error(const Plane& a, const Plane& b, const Plane& mask) {
  assert(a.samples.size() == b.samples.size() && a.samples.size() == mask.samples.size());
  SquaredError e;
  for (std::size_t i = 0; i < a.samples.size(); ++i)
    if (mask.samples[i] != 0) e.add(a.samples[i], b.samples[i]);
  return e;
}

}  // namespace fbs
