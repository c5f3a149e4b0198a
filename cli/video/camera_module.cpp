// The module fbs_camera: live pictures through OpenCV, which may throw; no exception leaves this file.

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <exception>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>
#include <string_view>
#include <utility>

#include "cli/program/module.h"
#include "cli/video/colour.h"
#include "cli/video/picture_size.h"
#include "cli/video/timestamps.h"
#include "cli/video/video_modules.h"

namespace fbs {
namespace {

constexpr double kDefaultRate = 30;  // pictures per second, for cameras that do not report theirs

/// Converts OpenCV's BGR to limited-range BT.601. Pictures get their time of arrival.
class CameraSource final : public VideoSource {
 public:
  explicit CameraSource(std::string name) : name_(std::move(name)) {}

  Result<void> open(int index) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    if (!camera_.open(index, cv::CAP_V4L2) || !camera_.read(image_) || image_.type() != CV_8UC3) {
      return fail(ErrorCode::kIo, "cannot read " + name_ + ": no such camera, or no permission to use it");
    }
    image_waiting_ = true;
    const double reported = camera_.get(cv::CAP_PROP_FPS);
    const double rate = reported >= 1 && reported <= 1000 ? reported : kDefaultRate;
    format_.width = image_.cols;
    format_.height = image_.rows;
    format_.frame_rate = {static_cast<std::uint32_t>(std::lround(rate * 1000)), 1000};
    format_.matrix = ColourMatrix::kBt601;
    return check_picture_size(name_, format_.width, format_.height);
  }

  [[nodiscard]] const VideoFormat& format() const override { return format_; }

  Result<std::optional<TimedPicture>> next() override {
    try {
      return grab();
    } catch (const std::exception& problem) {
      return fail(ErrorCode::kIo, "cannot read " + name_ + ": " + problem.what());
    }
  }

  [[nodiscard]] std::optional<std::int64_t> frame_count_estimate() const override { return std::nullopt; }

 private:
  using Clock = std::chrono::steady_clock;
  using Ticks = std::chrono::duration<std::int64_t, std::ratio<1, kTicksPerSecond>>;

  Result<std::optional<TimedPicture>> grab() {
    if (!std::exchange(image_waiting_, false) && !camera_.read(image_)) return std::nullopt;  // unplugged
    if (image_.cols != format_.width || image_.rows != format_.height) {
      return size_change(name_, format_, image_.cols, image_.rows);
    }
    const Clock::time_point now = Clock::now();
    if (last_pts_ < 0) begun_ = now;
    last_pts_ = std::max(last_pts_ + 1, std::chrono::duration_cast<Ticks>(now - begun_).count());

    if (!image_.isContinuous()) image_ = image_.clone();
    const std::span<const std::uint8_t> bgr(image_.data, image_.total() * image_.elemSize());
    return TimedPicture{
        picture_from_rgb(bgr, image_.cols, image_.rows, format_.range, format_.matrix, ChannelOrder::kBgr),
        last_pts_};
  }

  std::string name_;
  cv::VideoCapture camera_;
  cv::Mat image_;
  bool image_waiting_ = false;  ///< image_ was read by open() and not yet returned
  VideoFormat format_;
  Clock::time_point begun_;
  std::int64_t last_pts_ = -1;
};

Result<std::unique_ptr<VideoSource>> open_camera_source(const std::string& input) {
  const std::string_view number = std::string_view(input).substr(std::string_view("camera:").size());
  int index = -1;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
  if (error != std::errc() || end != number.data() + number.size() || index < 0) {
    return fail(ErrorCode::kInvalidArgument,
                "cannot read " + input + ": a camera is camera:0, camera:1, ...");
  }
  auto source = std::make_unique<CameraSource>(input);
  if (auto opened = source->open(index); !opened) return fail(opened.error());
  return source;
}

}  // namespace
}  // namespace fbs

FBS_MODULE_EXPORT void fbs_open_source(const std::string& input, const fbs::SourceOptions& /*options*/,
                                       fbs::Result<std::unique_ptr<fbs::VideoSource>>& source) {
  try {
    source = fbs::open_camera_source(input);
  } catch (const std::exception& problem) {
    source = fbs::fail(fbs::ErrorCode::kIo, "cannot read " + input + ": " + problem.what());
  }
}

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  static const std::string text = "OpenCV " + cv::getVersionString();
  return text.c_str();
}
