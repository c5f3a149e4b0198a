#include "cli/display/pattern_overlay.h"

#include <opencv2/imgproc.hpp>

#include "cli/display/pattern_legend.h"
#include "cli/display/pattern_tint.h"
#include "cli/stream/picture_sources.h"
#include "decoder/blend/picture_blend.h"

namespace fbs::cli {
namespace {

/// Share of the colour; the rest is the picture's brightness. Set by eye: colours can be told apart on skin
/// and on dark hair, and the face stays readable.
constexpr double kTintOpacity = 0.45;

cv::Mat tinted(const cv::Mat& image, RgbImage& tint) {
  const cv::Mat colours(tint.height, tint.width, CV_8UC3, tint.samples.data());
  cv::Mat large, grey, out;
  cv::resize(colours, large, image.size(), 0, 0, cv::INTER_LINEAR);
  // The picture's own colours could be mistaken for patterns'.
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, grey, cv::COLOR_GRAY2BGR);
  cv::addWeighted(large, kTintOpacity, grey, 1 - kTintOpacity, 0, out);
  return out;
}

PictureSources sources_of(const StreamDecoder& decoder, const DrawnState& drawn) {
  PictureSources out = picture_sources(decoder, drawn.state);
  if (!drawn.pattern || *drawn.pattern >= out.in_slot.size()) return out;
  for (std::vector<PatternWeight>& region : out.regions)
    if (!region.empty()) region = {{out.in_slot[*drawn.pattern], region.front().still, kBlendOne}};
  return out;
}

RgbImage plain_tint(const Bgr& colour) {
  return {1, 1, {colour.begin(), colour.end()}};
}

Result<cv::Mat> tinted_by(const PictureSources& sources, const Scene& scene, const DrawnState& drawn,
                          const cv::Mat& image) {
  Result<RgbImage> tint = drawn.pattern && *drawn.pattern < sources.in_slot.size()
                              ? plain_tint(pattern_colour(sources.in_slot[*drawn.pattern]))
                              : pattern_tint(scene, drawn.state, sources.in_slot);
  if (!tint) return fail(tint.error());
  return tinted(image, *tint);
}

cv::Mat beside(const cv::Mat& left, const cv::Mat& right) {
  cv::Mat out(std::max(left.rows, right.rows), left.cols + right.cols, CV_8UC3, cv::Scalar());
  left.copyTo(out(cv::Rect({0, 0}, left.size())));
  right.copyTo(out(cv::Rect({left.cols, 0}, right.size())));
  return out;
}

}  // namespace

Result<cv::Mat> pattern_tinted(const StreamDecoder& decoder, const DrawnState& drawn, const cv::Mat& image) {
  if (decoder.scene().patterns.empty()) return image;
  return tinted_by(sources_of(decoder, drawn), decoder.scene(), drawn, image);
}

Result<cv::Mat> pattern_overlay(const StreamDecoder& decoder, const DrawnState& drawn, const cv::Mat& image) {
  if (decoder.scene().patterns.empty()) return image;
  const PictureSources sources = sources_of(decoder, drawn);
  const auto tinted = tinted_by(sources, decoder.scene(), drawn, image);
  if (!tinted) return fail(tinted.error());
  return beside(*tinted, pattern_legend(sources, image.rows));
}

Result<cv::Mat> pattern_overlay(const StreamDecoder& decoder, const cv::Mat& image) {
  return pattern_overlay(decoder, {decoder.state(), std::nullopt}, image);
}

}  // namespace fbs::cli
