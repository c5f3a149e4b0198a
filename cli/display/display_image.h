// A picture as an image for the eye.
#pragma once

#include <opencv2/core.hpp>

#include "common/picture.h"

namespace fbs::cli {

/// By how much small pictures are enlarged, so that details are seen.
[[nodiscard]] int display_zoom(const VideoFormat& format);

/// The picture in BGR, enlarged by display_zoom().
[[nodiscard]] cv::Mat display_image(const Picture& picture, const VideoFormat& format);

}  // namespace fbs::cli
