// Our planes as OpenCV matrices, without copying.
#pragma once

#include <opencv2/core.hpp>

#include "common/picture.h"

namespace fbs {

/// A header over the plane's samples; not to be written through, and not to outlive the plane.
[[nodiscard]] inline cv::Mat view(const Plane& p) {
  // OpenCV has no view of const samples.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  return {p.height, p.width, CV_8UC1, const_cast<std::uint8_t*>(p.samples.data())};
}

}  // namespace fbs
