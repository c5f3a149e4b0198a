#include "encoder/fit/luma_pyramid.h"

namespace fbs {

LumaPyramid::LumaPyramid(const WorkFrame& frame, int levels) : scale_(frame.scale), origin_(frame.origin) {
  luma_[0] = frame.luma;
  for (int l = 1; l < levels; ++l) cv::pyrDown(luma_[l - 1], luma_[l]);
}

}  // namespace fbs
