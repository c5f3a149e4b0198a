#include "encoder/landmarks/face_patch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "encoder/image/pyramid.h"

namespace fbs {
namespace {

/// Part of 0..limit that first..first + count covers.
cv::Range inside(int first, int count, int limit) {
  return {std::max(first, 0), std::min(first + count, limit)};
}

}  // namespace

FacePlace place_of(const Shape& landmarks) {
  return {mean_of(landmarks), eye_distance(landmarks)};
}

FacePatch::FacePatch(const cv::Mat& picture, const FacePlace& place) {
  // Whole pixels of the picture, some of which are inside it.
  const int side =
      std::max(4, static_cast<int>(std::lround(place.eye_distance_px * kPatchSide / kPatchEyeDistance)));
  const auto first = [&](double centre, int limit) {
    return static_cast<int>(std::lround(std::clamp(centre, 0.0, static_cast<double>(limit)) - side / 2.0));
  };
  const cv::Point corner(first(place.centre.x, picture.cols), first(place.centre.y, picture.rows));
  const cv::Range columns = inside(corner.x, side, picture.cols), rows = inside(corner.y, side, picture.rows);
  cv::Mat cut;
  cv::copyMakeBorder(picture(rows, columns), cut, rows.start - corner.y, corner.y + side - rows.end,
                     columns.start - corner.x, corner.x + side - columns.end, cv::BORDER_REPLICATE);
  luma_ = resized(cut, {kPatchSide, kPatchSide});
  corner_ = {corner.x, corner.y};
  scale_ = static_cast<double>(kPatchSide) / side;
}

}  // namespace fbs
