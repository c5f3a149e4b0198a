#include "encoder/shots/fade_in.h"

#include <utility>

namespace fbs {
namespace {

/// Contrast against the first picture's from which a scene is worth its bytes again: quantised for the dark
/// one, it is shown with errors as many times as large.
constexpr double kMuchMore = 1.5;

/// Growth of the contrast over the last pictures that counts as none.
constexpr double kStill = 1.03;

/// Correlation with the first picture if only the light differs; heads and lips move meanwhile.
constexpr double kAlike = 0.7;

/// Standard deviation, luma levels, below which the first picture shows nothing to compare with.
constexpr double kPlainFirstBelow = 4;

struct Levels {
  double mean = 0, deviation = 0;
  explicit Levels(const cv::Mat1f& picture) {
    cv::Scalar m, d;
    cv::meanStdDev(picture, m, d);
    mean = m[0];
    deviation = d[0];
  }
};

bool are_alike(const cv::Mat1f& a, const Levels& of_a, const cv::Mat1f& b, const Levels& of_b) {
  const double covariance = a.dot(b) / static_cast<double>(a.total()) - of_a.mean * of_b.mean;
  return covariance > kAlike * of_a.deviation * of_b.deviation;
}

}  // namespace

bool FadeIn::has_ended(const cv::Mat1f& now) {
  const Levels levels(now);
  if (seen_ == 0) {
    first_ = now;
    contrast_.fill(levels.deviation);
  }
  const double before = std::exchange(contrast_[seen_++ % kSettled], levels.deviation);
  const Levels first(first_);
  const bool much_more =
      levels.deviation >= kMuchMore * first.deviation && levels.deviation >= kPlainFirstBelow;
  rises_ = much_more && levels.deviation > kStill * before;
  if (!much_more || rises_) return false;
  if (first.deviation >= kPlainFirstBelow && !are_alike(first_, first, now, levels)) return false;
  first_ = now;
  return true;
}

}  // namespace fbs
