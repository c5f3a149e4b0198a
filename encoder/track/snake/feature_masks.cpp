#include "encoder/track/snake/feature_masks.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "encoder/track/snake/feature_patch.h"

namespace fbs {
namespace {

// Widths of the masks, snake units; set by eye on the first pictures of the ten clips.
constexpr double kSkinRoundLips = 4, kLipsEdge = 1;    // width of the skin, and of the edge that is left out
constexpr double kInnerLipsBand = 2, kInnerGap = 0.7;  // lips lie between these distances from their line
constexpr double kBrowWidth = 2, kSkinRoundBrow = 4.5, kBrowEdge = 2;
constexpr double kLidLine = 1.4, kLashesBelow = 1, kLidSkinAbove = -2;

using Outline = std::vector<cv::Point>;

int to_pixels(double units) {
  return static_cast<int>(std::lround(units * kPatchPxPerUnit));
}

cv::Mat grown(const cv::Mat& mask, double radius) {
  const int r = std::max(1, to_pixels(radius));
  cv::Mat out;
  cv::dilate(mask, out, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * r + 1, 2 * r + 1}));
  return out;
}

cv::Mat filled(const Outline& outline, cv::Size size) {
  cv::Mat out = cv::Mat::zeros(size, CV_8UC1);
  cv::fillPoly(out, std::vector<Outline>{outline}, 255);
  return out;
}

cv::Mat line(Outline outline, cv::Size size, double width, double down = 0) {
  for (cv::Point& p : outline) p.y += to_pixels(down);
  cv::Mat out = cv::Mat::zeros(size, CV_8UC1);
  cv::polylines(out, outline, false, 255, to_pixels(width));
  return out;
}

}  // namespace

FeatureMasks feature_masks(FeatureId id, const Outline& outline, cv::Size patch) {
  switch (id) {
    case FeatureId::kMouthOuter: {
      const cv::Mat lips = filled(outline, patch);
      return {lips, grown(lips, kSkinRoundLips) - grown(lips, kLipsEdge)};
    }
    case FeatureId::kMouthInner: {
      // The lips themselves: a band around the line between them.
      const cv::Mat gap = filled(outline, patch);
      return {grown(gap, kInnerLipsBand) - grown(gap, kInnerGap), {}};
    }
    case FeatureId::kBrowRight:
    case FeatureId::kBrowLeft: {
      const cv::Mat brow = line(outline, patch, kBrowWidth);
      return {brow, grown(brow, kSkinRoundBrow) - grown(brow, kBrowEdge)};
    }
    default:
      // Lashes and eye below the lid's edge, the lid's skin above it.
      return {line(outline, patch, kLidLine, kLashesBelow), line(outline, patch, kLidLine, kLidSkinAbove)};
  }
}

}  // namespace fbs
