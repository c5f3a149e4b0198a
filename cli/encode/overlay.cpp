#include "cli/encode/overlay.h"

#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "cli/display/display_image.h"
#include "cli/video/colour.h"
#include "cli/video/constant_rate.h"
#include "cli/video/open/open_video.h"
#include "cli/video/timestamps.h"
#include "cli/video/y4m/y4m.h"

namespace fbs::cli {
namespace {

constexpr int kShift = 4;  // OpenCV draws with positions in 1/16 pixel

const cv::Scalar kMeshColour(90, 200, 90), kSnakeColour(40, 60, 255);

cv::Point fixed(glm::dvec2 p, int zoom) {
  const double one = zoom * (1 << kShift);
  return {static_cast<int>(p.x * one), static_cast<int>(p.y * one)};
}

}  // namespace

Result<Overlay> Overlay::create(const std::string& name, const VideoFormat& format) {
  const int zoom = display_zoom(format);
  VideoFormat enlarged = format;
  enlarged.width *= zoom;
  enlarged.height *= zoom;
  auto sink = open_video_sink(name, enlarged);
  if (!sink) return fail(sink.error());
  if (is_y4m_output(name) && plausible_rate(format.frame_rate))
    *sink = std::make_unique<ConstantRateSink>(std::move(*sink), format.frame_rate, true);
  return Overlay(std::move(*sink), format, zoom);
}

Result<void> Overlay::write(const Picture& picture, std::int64_t pts, const PictureAnalysis& analysis) {
  cv::Mat large = display_image(picture, format_);
  if (analysis.face) {
    for (const HeadTriangle& t : generic_head().triangles)
      for (std::size_t i = 0; i < 3; ++i)
        cv::line(large, fixed(analysis.vertices[t[i]], zoom_),
                 fixed(analysis.vertices[t[(i + 1) % 3]], zoom_), kMeshColour, 1, cv::LINE_AA, kShift);
    for (const SnakeOutline& snake : analysis.snakes) {
      std::vector<cv::Point> points;
      points.reserve(snake.points.size());
      for (const glm::dvec2 p : snake.points) points.push_back(fixed(p, zoom_));
      cv::polylines(large, points, snake.closed, kSnakeColour, 2, cv::LINE_AA, kShift);
    }
    char text[64];
    std::snprintf(text, sizeof text, "confidence %.2f", analysis.confidence);
    cv::putText(large, text, {8, large.rows - 10}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {255, 255, 255}, 1,
                cv::LINE_AA);
  }
  return sink_->write(picture_from_rgb({large.data, large.total() * 3}, large.cols, large.rows, format_.range,
                                       format_.matrix, ChannelOrder::kBgr),
                      pts);
}

}  // namespace fbs::cli
