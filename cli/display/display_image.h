// A picture as an image for the viewer.
#pragma once

#include <opencv2/core.hpp>

#include "common/picture.h"

namespace fbs::cli {

/// Factor by which small pictures are enlarged to show details.
[[nodiscard]] int display_zoom(const VideoFormat& format);

/// The picture in BGR, enlarged by display_zoom().
[[nodiscard]] cv::Mat display_image(const Picture& picture, const VideoFormat& format);

}  // namespace fbs::cli
