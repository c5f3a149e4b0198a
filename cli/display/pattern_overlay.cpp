#include "cli/display/pattern_overlay.h"

#include <opencv2/imgproc.hpp>

#include "cli/display/pattern_legend.h"
#include "cli/display/pattern_tint.h"
#include "cli/display/picture_sources.h"

namespace fbs::cli {
namespace {

/// Share of the colour; the picture's brightness has the rest. Set by eye: colours can be told apart on skin
/// and on dark hair, and the face can still be read.
constexpr double kTintOpacity = 0.45;

cv::Mat tinted(const cv::Mat& image, RgbImage& tint) {
  const cv::Mat colours(tint.height, tint.width, CV_8UC3, tint.samples.data());
  cv::Mat large, grey, out;
  cv::resize(colours, large, image.size(), 0, 0, cv::INTER_LINEAR);
  // Colours of the picture would be taken for those of patterns.
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, grey, cv::COLOR_GRAY2BGR);
  cv::addWeighted(large, kTintOpacity, grey, 1 - kTintOpacity, 0, out);
  return out;
}

cv::Mat beside(const cv::Mat& left, const cv::Mat& right) {
  cv::Mat out(std::max(left.rows, right.rows), left.cols + right.cols, CV_8UC3, cv::Scalar());
  left.copyTo(out(cv::Rect({0, 0}, left.size())));
  right.copyTo(out(cv::Rect({left.cols, 0}, right.size())));
  return out;
}

}  // namespace

Result<cv::Mat> pattern_overlay(const StreamDecoder& decoder, const cv::Mat& image) {
  const Scene& scene = decoder.scene();
  if (scene.patterns.empty()) return image;
  const PictureSources sources = picture_sources(decoder);
  auto tint = pattern_tint(scene, decoder.state(), sources.in_slot);
  if (!tint) return fail(tint.error());
  return beside(tinted(image, *tint), pattern_legend(sources, image.rows));
}

}  // namespace fbs::cli
