#include "encoder/surround/surround_cost.h"

#include <algorithm>

#include "encoder/image/robust.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

namespace {

constexpr int kFirst = first_of(PartId::kBody);
static_assert(first_of(PartId::kGround) == kFirst + kSimilarityCount);
constexpr int kNumbers = 2 * kSimilarityCount;  // body's, then the ground's
using Quadratic = double[kNumbers][kNumbers];   // upper triangle

const LayerShares& shares_of(const Keypoint& keypoint, bool mapped) {
  return mapped ? keypoint.layers.share() : keypoint.layers.weight();
}

/// A square of the work picture represents factor^2 as many samples, whose slopes are smaller by as much.
void add(const Keypoint& keypoint, const LayerShares& share, Quadratic& sum) {
  const auto most = std::max_element(share.begin(), share.end()) - share.begin();
  const auto visible = static_cast<double>(keypoint.layers.visible()[most]);
  const auto xx = static_cast<double>(keypoint.structure[0]), xy = static_cast<double>(keypoint.structure[1]),
             yy = static_cast<double>(keypoint.structure[2]);
  const glm::dvec2 d = keypoint.from_head;
  const double by_x[4] = {1, 0, d.x, -d.y}, by_y[4] = {0, 1, d.y, d.x};
  double one[4][4];
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j)
      one[i][j] = visible * (xx * by_x[i] * by_x[j] + xy * (by_x[i] * by_y[j] + by_y[i] * by_x[j]) +
                             yy * by_y[i] * by_y[j]);
  const double part[2] = {static_cast<double>(share[kBodyLayer]), static_cast<double>(share[kGroundLayer])};
  for (int a = 0; a < 2; ++a)
    for (int b = a; b < 2; ++b)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          sum[4 * a + i][4 * b + j] += part[a] * part[b] * one[std::min(i, j)][std::max(i, j)];
}

}  // namespace

glm::dvec2 LayerMotion::displacement_of(const Keypoint& keypoint, const LayerShares& share) const {
  return static_cast<double>(share[kHeadLayer]) * head(keypoint.place) +
         static_cast<double>(share[kBodyLayer]) * displacement(body, keypoint.from_head) +
         static_cast<double>(share[kGroundLayer]) * displacement(ground, keypoint.from_head);
}

cv::Mat1d surround_quadratic(std::span<const Keypoint> keypoints, bool mapped) {
  Quadratic sum = {};
  for (const Keypoint& keypoint : keypoints) add(keypoint, shares_of(keypoint, mapped), sum);
  cv::Mat1d out(kParameterCount, kParameterCount, 0.0);
  for (int i = 0; i < kNumbers; ++i)
    for (int j = 0; j < kNumbers; ++j)
      out(kFirst + i, kFirst + j) =
          sum[std::min(i, j)][std::max(i, j)] / (kStateUnitsPerPixel * kStateUnitsPerPixel);
  return out;
}

double surround_constant(std::span<const Keypoint> keypoints, bool mapped, const cv::Mat& now, int factor,
                         const LayerMotion& motion) {
  const auto to_work = static_cast<double>(factor);
  double sum = 0;
  for (const Keypoint& keypoint : keypoints) {
    const glm::dvec2 by = motion.displacement_of(keypoint, shares_of(keypoint, mapped)) / to_work;
    for (const Keypoint::Quarter& quarter : keypoint.quarters) {
      const glm::dvec2 at = glm::dvec2(quarter.at) + by;
      if (!has_cell(now, at)) continue;
      const double r = bilinear<std::uint8_t>(now, BilinearCell(at)) - static_cast<double>(quarter.value);
      sum += geman_mcclure(r * r, kOutlierSigma * kOutlierSigma);
    }
  }
  const double samples_per_quarter = kSquare * kSquare / 4.0 * to_work * to_work;
  return sum * samples_per_quarter;
}

}  // namespace fbs
