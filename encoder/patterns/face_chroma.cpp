#include "encoder/patterns/face_chroma.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

constexpr int kSteps = 64;           // at most this many samples of a picture each way
constexpr double kOutside = 0.002;   // share of the samples that may be clipped: lipstick is more than that
constexpr std::int32_t kRoom = 112;  // from grey, for the others; later pictures may be more colourful

}  // namespace

void FaceChroma::add(const Picture& picture, std::span<const glm::ivec3> vertices) {
  const auto [left, right] = std::ranges::minmax(vertices, {}, [](const glm::ivec3& p) { return p.x; });
  const auto [top, bottom] = std::ranges::minmax(vertices, {}, [](const glm::ivec3& p) { return p.y; });
  constexpr int kChromaOneLog2 = kScreenOneLog2 + 1;
  const auto column = [&](int x) { return std::clamp(x >> kChromaOneLog2, 0, picture.u.width); };
  const auto row = [&](int y) { return std::clamp(y >> kChromaOneLog2, 0, picture.u.height); };
  for (const Plane* plane : {&picture.u, &picture.v})
    add(*plane, column(left.x), row(top.y), column(right.x), row(bottom.y));
}

void FaceChroma::add(const Plane& plane, int x0, int y0, int x1, int y1) {
  const int dx = (x1 - x0) / kSteps + 1, dy = (y1 - y0) / kSteps + 1;
  for (int y = y0; y < y1; y += dy)
    for (int x = x0; x < x1; x += dx) ++count_[std::abs(plane.row(y)[x] - 128)];
}

std::int32_t FaceChroma::contrast() const {
  const auto all = static_cast<double>(std::accumulate(count_.begin(), count_.end(), std::int64_t{0}));
  if (all == 0) return kContrastOne;
  int level = static_cast<int>(count_.size()) - 1;
  for (double beyond = 0; level > 1; --level) {
    beyond += static_cast<double>(count_[level]);
    if (beyond > kOutside * all) break;
  }
  return std::clamp(kContrastOne * kRoom / level / 2 * 2, kContrastOne, kWantedChromaContrast);
}

}  // namespace fbs
