#include "cli/display/display_image.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "cli/video/colour.h"

namespace fbs::cli {
namespace {

constexpr int kWantedHeight = 576;  // pixels; fits every screen with room to spare
constexpr int kMaxZoom = 4;

}  // namespace

int display_zoom(const VideoFormat& format) {
  return std::clamp(kWantedHeight / format.height, 1, kMaxZoom);
}

cv::Mat display_image(const Picture& picture, const VideoFormat& format) {
  RgbImage rgb = rgb_from_picture(picture, format.range, format.matrix, ChannelOrder::kBgr);
  const cv::Mat image(rgb.height, rgb.width, CV_8UC3, rgb.samples.data());
  const int zoom = display_zoom(format);
  cv::Mat large;
  cv::resize(image, large, {}, zoom, zoom, cv::INTER_CUBIC);
  return large;
}

}  // namespace fbs::cli
