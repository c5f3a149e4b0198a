// Pictures without a face, which must not be mistaken for one: grain and blobs of all sizes, and text.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace fbs {

[[nodiscard]] std::vector<cv::Mat1b> draw_textures(int count);

}  // namespace fbs
