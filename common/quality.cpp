#include "common/quality.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace fbs {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 6.5025, kC2 = 58.5225;  // (0.01 * 255)^2, (0.03 * 255)^2

using Image = std::vector<float>;

std::array<float, 2 * kRadius + 1> gaussian() {
  std::array<float, 2 * kRadius + 1> k{};
  double sum = 0;
  for (int i = -kRadius; i <= kRadius; ++i) sum += std::exp(-i * i / (2 * kSigma * kSigma));
  for (int i = -kRadius; i <= kRadius; ++i)
    k[i + kRadius] = static_cast<float>(std::exp(-i * i / (2 * kSigma * kSigma)) / sum);
  return k;
}

/// Index mirrored at the border without repeating the border sample, like OpenCV's default.
int reflected(int i, int n) {
  if (n == 1) return 0;
  while (i < 0 || i >= n) i = i < 0 ? -i : 2 * n - 2 - i;
  return i;
}

Image blurred(const Image& in, int w, int h) {
  static const auto kernel = gaussian();
  Image rows(in.size()), out(in.size());
  for (int y = 0; y < h; ++y) {
    const float* from = in.data() + static_cast<std::ptrdiff_t>(y) * w;
    float* to = rows.data() + static_cast<std::ptrdiff_t>(y) * w;
    for (int x = 0; x < w; ++x) {
      float sum = 0;
      for (int k = -kRadius; k <= kRadius; ++k) sum += kernel[k + kRadius] * from[reflected(x + k, w)];
      to[x] = sum;
    }
  }
  for (int y = 0; y < h; ++y) {
    float* to = out.data() + static_cast<std::ptrdiff_t>(y) * w;
    for (int k = -kRadius; k <= kRadius; ++k) {
      const float weight = kernel[k + kRadius];
      const float* from = rows.data() + static_cast<std::ptrdiff_t>(reflected(y + k, h)) * w;
      for (int x = 0; x < w; ++x) to[x] += weight * from[x];
    }
  }
  return out;
}

Image product(const Plane& a, const Plane& b) {
  Image out(a.samples.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(a.samples[i] * b.samples[i]);
  return out;
}

}  // namespace

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

double ssim(const Plane& a, const Plane& b) {
  assert(a.width == b.width && a.height == b.height);
  const int w = a.width, h = a.height;
  const Image ma = blurred({a.samples.begin(), a.samples.end()}, w, h),
              mb = blurred({b.samples.begin(), b.samples.end()}, w, h);
  const Image aa = blurred(product(a, a), w, h), bb = blurred(product(b, b), w, h),
              ab = blurred(product(a, b), w, h);
  double sum = 0;
  for (std::size_t i = 0; i < ma.size(); ++i) {
    const double x = static_cast<double>(ma[i]), y = static_cast<double>(mb[i]);
    const double vx = static_cast<double>(aa[i]) - x * x, vy = static_cast<double>(bb[i]) - y * y;
    const double cov = static_cast<double>(ab[i]) - x * y;
    sum += ((2 * x * y + kC1) * (2 * cov + kC2)) / ((x * x + y * y + kC1) * (vx + vy + kC2));
  }
  return sum / static_cast<double>(ma.size());
}

}  // namespace fbs
