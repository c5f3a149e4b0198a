#include "encoder/patterns/chroma_contrast.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "bitstream/syntax.h"

namespace fbs {
namespace {

constexpr int kSteps = 64;           // at most this many samples of a picture each way
constexpr double kOutside = 0.002;   // share of the samples that may be clipped: lipstick is more than that
constexpr std::int32_t kRoom = 112;  // from grey, for the others; later pictures may be more colourful

}  // namespace

void ChromaContrast::add(const Picture& picture) {
  const int dx = (picture.u.width - 1) / kSteps + 1, dy = (picture.u.height - 1) / kSteps + 1;
  for (const Plane* plane : {&picture.u, &picture.v})
    for (int y = 0; y < plane->height; y += dy)
      for (int x = 0; x < plane->width; x += dx) ++count_[std::abs(plane->row(y)[x] - 128)];
}

std::int32_t ChromaContrast::contrast() const {
  const auto all = static_cast<double>(std::accumulate(count_.begin(), count_.end(), std::int64_t{0}));
  if (all == 0) return kContrastOne;
  int level = static_cast<int>(count_.size()) - 1;
  for (double beyond = 0; level > 1; --level) {
    beyond += static_cast<double>(count_[level]);
    if (beyond > kOutside * all) break;
  }
  return std::clamp(kContrastOne * kRoom / level / 2 * 2, kContrastOne, most_);
}

}  // namespace fbs
