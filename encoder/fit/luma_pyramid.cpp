#include "encoder/fit/luma_pyramid.h"

namespace fbs {

LumaPyramid::LumaPyramid(const WorkFrame& frame)
    : scale_(frame.scale), origin_(frame.origin), luma_(make_pyramid<kFitLevels>(frame.luma)) {}

}  // namespace fbs
