#include "encoder/plan/group_cost.h"

#include <algorithm>
#include <cmath>

namespace fbs {
GroupCost::GroupCost(std::span<const PictureCost> pictures, const cv::Mat1d& penalty,
                     const std::array<double, kParameterCount>& step)
    : target_(pictures.size()), quadratic_(pictures.size()) {
  for (std::size_t t = 0; t < pictures.size(); ++t) {
    cv::Mat1d sum = pictures[t].quadratic();
    if (!penalty.empty()) sum += penalty;
    quadratic_[t].resize(kParameterCount * kParameterCount);
    for (std::size_t i = 0; i < kParameterCount; ++i) {
      target_[t][i] = pictures[t].fit[i] / step[i];
      const double* row = sum[static_cast<int>(i)];
      for (std::size_t j = 0; j < kParameterCount; ++j)
        quadratic_[t][i * kParameterCount + j] = static_cast<float>(row[j] * step[i] * step[j]);
    }
  }
}

double GroupCost::distortion(std::size_t part, std::size_t t, const PartPoint& x) const {
  const std::size_t n = kPartSizes[part], first = kPartFirst[part];
  std::array<float, kMaxPartSize> e;
  for (std::size_t k = 0; k < n; ++k) e[k] = static_cast<float>(x[k] - target_[t][first + k]);
  float sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const float* row = quadratic(t) + (first + k) * kParameterCount + first;
    float dot = 0;
    for (std::size_t l = 0; l < n; ++l) dot += row[l] * e[l];
    sum += dot * e[k];
  }
  return static_cast<double>(sum);
}

PartValues GroupCost::rounded(std::size_t part, std::size_t t, const CodedLimits& limits) const {
  PartValues v{};
  for (std::size_t k = 0; k < kPartSizes[part]; ++k) {
    const std::size_t i = kPartFirst[part] + k;
    v[k] = static_cast<std::int32_t>(
        std::clamp<double>(std::round(target_[t][i]), limits.min[i], limits.max[i]));
  }
  return v;
}

}  // namespace fbs
