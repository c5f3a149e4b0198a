#include "encoder/track/snake/feature_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fbs {
namespace {

// Tuned by eye on the ten clips.
/// Variance assumed for every sample of Y, U, V, squared grey levels: regularises the covariances of small
/// patches.
constexpr double kSampleVariance[3] = {30, 6, 6};

/// Limits of the map: a dark open mouth is no more lip than lips are, and teeth are no less lip than skin is.
constexpr float kMinMap = -0.25F, kMaxMap = 1.1F;

/// Lips change colour with light and stretch: factors on one picture's variance, and on kSampleVariance.
constexpr double kLikenessVariance = 3, kLikenessSampleVariance = 4;
constexpr int kMinSamples = 8;  ///< of a class; with fewer the map is not learned

struct Class {
  cv::Vec3d mean;
  cv::Matx33d covariance = cv::Matx33d::zeros();
  int count = 0;
};

/// @param planes  0 stands for omitted planes
Class statistics(const std::array<cv::Mat, 3>& patch, const cv::Mat& mask, int planes = 3) {
  Class c;
  cv::Vec3d sum(0, 0, 0);
  cv::Matx33d product = cv::Matx33d::zeros();
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      cv::Vec3d v(0, 0, 0);
      for (int k = 0; k < planes; ++k) v[k] = patch[k].at<std::uint8_t>(y, x);
      sum += v;
      product += v * v.t();
      ++c.count;
    }
  }
  if (c.count == 0) return c;
  c.mean = sum * (1.0 / c.count);
  c.covariance = product * (1.0 / c.count) - c.mean * c.mean.t();
  return c;
}

}  // namespace

FeatureMap FeatureMap::discriminant(const std::array<cv::Mat, 3>& patch, const cv::Mat& inside,
                                    const cv::Mat& outside, bool luma_only) {
  FeatureMap map;
  const int planes = luma_only ? 1 : 3;
  const Class in = statistics(patch, inside, planes), out = statistics(patch, outside, planes);
  if (in.count < kMinSamples || out.count < kMinSamples) return map;
  cv::Matx33d pooled = 0.5 * (in.covariance + out.covariance);
  for (int k = 0; k < 3; ++k) pooled(k, k) += kSampleVariance[k];
  const cv::Vec3d difference = in.mean - out.mean;
  const cv::Vec3d w = pooled.inv() * difference;
  const double separation = w.dot(difference);
  if (separation < 1e-6) return map;
  map.weight_ = cv::Vec3f(static_cast<float>(w[0] / separation), static_cast<float>(w[1] / separation),
                          static_cast<float>(w[2] / separation));
  map.offset_ = static_cast<float>(-w.dot(out.mean) / separation);
  return map;
}

FeatureMap FeatureMap::likeness(const std::array<cv::Mat, 3>& patch, const cv::Mat& inside) {
  FeatureMap map;
  map.is_likeness_ = true;
  const Class in = statistics(patch, inside);
  if (in.count < kMinSamples) return map;
  cv::Matx33d covariance = in.covariance * kLikenessVariance;
  for (int k = 0; k < 3; ++k) covariance(k, k) += kLikenessSampleVariance * kSampleVariance[k];
  map.mean_ = in.mean;
  map.inverse_covariance_ = covariance.inv();
  return map;
}

cv::Mat1f FeatureMap::operator()(const std::array<cv::Mat, 3>& patch) const {
  cv::Mat1f out(patch[0].size());
  const cv::Matx33f& s = inverse_covariance_;
  const cv::Vec3f mean = mean_, weight = weight_;
  const float offset = offset_;
  const bool luma_only = !is_likeness_ && weight[1] == 0 && weight[2] == 0;
  for (int y = 0; y < out.rows; ++y) {
    const std::uint8_t* a = patch[0].ptr(y);
    const std::uint8_t *b = luma_only ? a : patch[1].ptr(y), *c = luma_only ? a : patch[2].ptr(y);
    float* to = out[y];
    if (is_likeness_) {
      for (int x = 0; x < out.cols; ++x) {
        const float d0 = a[x] - mean[0], d1 = b[x] - mean[1], d2 = c[x] - mean[2];
        to[x] = -0.5F * (s(0, 0) * d0 * d0 + s(1, 1) * d1 * d1 + s(2, 2) * d2 * d2) -
                (s(0, 1) * d0 * d1 + s(0, 2) * d0 * d2 + s(1, 2) * d1 * d2);
      }
    } else {
      for (int x = 0; x < out.cols; ++x) {
        const float mix = weight[0] * a[x] + weight[1] * b[x] + weight[2] * c[x] + offset;
        to[x] = std::min(std::max(mix, kMinMap), kMaxMap);
      }
    }
  }
  if (is_likeness_) cv::exp(out, out);
  return out;
}

}  // namespace fbs
