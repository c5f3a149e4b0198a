// Pictures of nothing, which must not be taken for faces: grain and blobs of all sizes.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace fbs {

[[nodiscard]] std::vector<cv::Mat1b> draw_textures(int count);

}  // namespace fbs
