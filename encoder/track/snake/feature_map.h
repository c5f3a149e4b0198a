// H of the paper's eq. 7, per feature and per person: what distinguishes a lip from the skin around it,
// learned on the first picture, where the marks tell them apart.
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace fbs {

/// A picture patch in which the feature is about 1 and its surroundings about 0.
class FeatureMap {
 public:
  /// A linear mix of luma and both chroma components: Fisher's linear discriminant with the two classes'
  /// covariances pooled and regularised.
  /// @param patch    8-bit Y, U, V planes of one size
  /// @param inside   8-bit mask of the feature, nonzero where it is
  /// @param outside  8-bit mask of the skin around it
  /// @param luma_only  for brows and lids: hair differs from skin in brightness, and chroma only adds noise;
  ///                   U and V may be empty
  static FeatureMap discriminant(const std::array<cv::Mat, 3>& patch, const cv::Mat& inside,
                                 const cv::Mat& outside, bool luma_only);

  /// Likeness of a colour to the feature's own: exp(-d^2 / 2) of a widened Mahalanobis distance. For lips
  /// seen from inside, where teeth, tongue and dark all differ from lip.
  static FeatureMap likeness(const std::array<cv::Mat, 3>& patch, const cv::Mat& inside);

  [[nodiscard]] cv::Mat1f operator()(const std::array<cv::Mat, 3>& patch) const;

 private:
  cv::Vec3f weight_{-0.02F, 0, 0};
  float offset_ = 0;
  bool is_likeness_ = false;
  cv::Vec3f mean_{0, 0, 0};
  cv::Matx33f inverse_covariance_ = cv::Matx33f::eye();
};

}  // namespace fbs
