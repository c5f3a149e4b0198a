#include "encoder/track/head/levelled_frame.h"

#include <glm/matrix.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "encoder/track/head/head_tuning.h"

namespace fbs {

using namespace head_tuning;

namespace {

cv::Mat levelled(const cv::Mat& luma) {
  // Means over a large Gaussian, computed at a quarter of the size.
  cv::Mat value, small, mean, variance;
  luma.convertTo(value, CV_32F);
  cv::GaussianBlur(value, value, {3, 3}, 0.8);
  const auto smooth = [&](const cv::Mat& in, cv::Mat& out) {
    cv::resize(in, small, {}, 0.25, 0.25, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, kLevellingReach / 4);
    cv::resize(small, out, in.size(), 0, 0, cv::INTER_LINEAR);
  };
  smooth(value, mean);
  value -= mean;
  smooth(value.mul(value), variance);
  variance += kMinLocalContrast * kMinLocalContrast;
  cv::sqrt(variance, variance);
  cv::Mat out;
  cv::divide(value, variance, value, kLevelledSigma);
  value.convertTo(out, CV_8U, 1, 128);
  return out;
}

}  // namespace

LevelledFrame::LevelledFrame(WorkFrame of)
    : frame(std::move(of)), levels(make_pyramid<kLevels>(levelled(frame.luma))) {}

LevelProjection::LevelProjection(const PoseProjection& projection, const WorkFrame& frame, int level) {
  const double scale = frame.scale / level_scale(level);
  const glm::dmat3 rows = glm::transpose(projection.matrix * scale);
  x = rows[0];
  y = rows[1];
  shift = on_level(frame.to_work(projection.shift), level);
}

}  // namespace fbs
