// H of the paper's eq. 7, per feature and per person: what tells a lip from the skin round it, learned on the first
// picture where the marks say which is which.
#pragma once

#include <opencv2/core.hpp>

namespace fbs {

/// A linear mix of luma and both chroma components, scaled so that the feature is about 1 and its surroundings 0.
/// Method: Fisher's linear discriminant with the two classes' covariances pooled and regularised.
class FeatureMap {
 public:
  /// @param patch    8-bit Y, U, V planes of one size
  /// @param inside   8-bit mask of the feature, nonzero where it is
  /// @param outside  8-bit mask of the skin round it
  /// @param luma_only  for brows: hair differs from skin in brightness, and chroma only adds noise
  static FeatureMap learn(const std::array<cv::Mat, 3>& patch, const cv::Mat& inside, const cv::Mat& outside, bool luma_only);

  [[nodiscard]] cv::Mat1f operator()(const std::array<cv::Mat, 3>& patch) const;

 private:
  cv::Vec3f weight_{-0.02F, 0, 0};
  float offset_ = 0;
};

}  // namespace fbs
