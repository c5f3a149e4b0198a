#include "encoder/fit/luma_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace fbs {

LumaPyramid::LumaPyramid(const WorkFrame& frame) : scale_(frame.scale), origin_(frame.origin) {
  luma_[0] = frame.luma;
  for (int level = 1; level < kFitLevels; ++level) cv::pyrDown(luma_[level - 1], luma_[level]);
}

}  // namespace fbs
