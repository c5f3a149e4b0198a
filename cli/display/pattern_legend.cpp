#include "cli/display/pattern_legend.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "cli/display/pattern_tint.h"
#include "decoder/blend/picture_blend.h"

namespace fbs::cli {
namespace {

// Pixels.
constexpr int kMargin = 10;
constexpr int kLine = 19;      ///< from one line of text to the next
constexpr int kBaseline = 14;  ///< of text in its line
constexpr int kBarLeft = 82;   ///< to the right of the longest region name
constexpr int kBarHeight = 13;
constexpr int kChipWidth = 27, kChipHeight = 15;
constexpr int kChipText = -2;  ///< from the top of a chip to the top of its line of text
constexpr int kChipStep = 31;  ///< from one chip of the store to the next
constexpr int kTextGap = 3;    ///< from a chip to its percentage
constexpr int kEntryGap = 8;   ///< from one weight to the next
constexpr int kHatchStep = 6;
constexpr int kHeadLines = 2;   ///< picture, patterns
constexpr int kEntryLines = 2;  ///< per region: enough for the largest blend; regions stay in place
constexpr int kRegionHeight = (1 + kEntryLines) * kLine + 4;

constexpr int kChipsPerLine = (kLegendWidth - 2 * kMargin) / kChipStep;

constexpr double kTextSize = 0.42;
const cv::Scalar kBackground(32, 32, 32), kText(225, 225, 225), kEmptyBar(60, 60, 60), kDark(0, 0, 0);

cv::Scalar colour_of(std::size_t number) {
  const Bgr c = pattern_colour(number);
  return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

int chip_lines(const PictureSources& sources) {
  return (static_cast<int>(sources.in_slot.size()) + kChipsPerLine - 1) / kChipsPerLine;
}

/// Top of the first region.
int regions_top(const PictureSources& sources) {
  return kMargin + (kHeadLines + chip_lines(sources)) * kLine + kMargin;
}

int region_top(const PictureSources& sources, std::size_t region) {
  return regions_top(sources) + static_cast<int>(region) * kRegionHeight;
}

void write(cv::Mat& image, const std::string& text, cv::Point top_left, const cv::Scalar& colour = kText) {
  cv::putText(image, text, top_left + cv::Point(0, kBaseline), cv::FONT_HERSHEY_SIMPLEX, kTextSize, colour, 1,
              cv::LINE_AA);
}

int width_of(const std::string& text) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kTextSize, 1, &baseline).width;
}

void hatch(cv::Mat area) {
  for (int x = -area.rows; x < area.cols; x += kHatchStep)
    cv::line(area, {x, area.rows}, {x + area.rows, 0}, kDark, 1, cv::LINE_AA);
}

/// A pattern's number on its colour.
void draw_chip(cv::Mat& image, std::size_t number, cv::Point top_left) {
  const cv::Scalar colour = colour_of(number);
  const cv::Rect chip(top_left, cv::Size(kChipWidth, kChipHeight));
  cv::rectangle(image, chip, colour, cv::FILLED);
  const double luma = 0.114 * colour[0] + 0.587 * colour[1] + 0.299 * colour[2];
  const std::string text = std::to_string(number);
  write(image, text, top_left + cv::Point((kChipWidth - width_of(text)) / 2, kChipText),
        luma > 110 ? kDark : cv::Scalar(255, 255, 255));
}

void draw_head(cv::Mat& image, const PictureSources& sources) {
  write(image, "picture " + std::to_string(sources.picture), {kMargin, kMargin});
  write(image,
        std::to_string(sources.arrived) + (sources.arrived == 1 ? " pattern has" : " patterns have") +
            " arrived; stored:",
        {kMargin, kMargin + kLine});
  std::vector<std::size_t> stored = sources.in_slot;
  std::ranges::sort(stored);
  for (int i = 0; i < static_cast<int>(stored.size()); ++i)
    draw_chip(image, stored[i],
              {kMargin + i % kChipsPerLine * kChipStep, kMargin + (kHeadLines + i / kChipsPerLine) * kLine});
}

void draw_bar(cv::Mat bar, const std::vector<PatternWeight>& weights) {
  bar.setTo(kEmptyBar);
  int sum = 0;
  for (const PatternWeight& w : weights) {
    const int begin = bar.cols * sum / kBlendOne;
    sum += w.weight;
    cv::Mat part = bar.colRange(begin, bar.cols * sum / kBlendOne);
    if (part.empty()) continue;  // less than a pixel
    part.setTo(colour_of(w.number));
    if (w.still) hatch(part);
  }
}

std::string weight_text(const PatternWeight& w) {
  const int percent = (100 * w.weight + kBlendOne / 2) / kBlendOne;
  return (percent == 0 ? "<1" : std::to_string(percent)) + (w.still ? "% still" : "%");
}

/// Draws weights one after another, in as many lines as they need.
void draw_weights(cv::Mat& image, const std::vector<PatternWeight>& weights, cv::Point at) {
  for (const PatternWeight& w : weights) {
    const std::string text = weight_text(w);
    const int width = kChipWidth + kTextGap + width_of(text);
    if (at.x + width > kLegendWidth - kMargin) at = {kMargin, at.y + kLine};
    draw_chip(image, w.number, at);
    write(image, text, at + cv::Point(kChipWidth + kTextGap, kChipText));
    at.x += width + kEntryGap;
  }
}

void draw_region(cv::Mat& image, const PictureSources& sources, std::size_t region) {
  const int top = region_top(sources, region);
  write(image, std::string(kRegionNames[region]), {kMargin, top});
  draw_bar(image(legend_bar(sources, static_cast<Region>(region))), sources.regions[region]);
  draw_weights(image, sources.regions[region], {kMargin, top + kLine});
}

}  // namespace

cv::Rect legend_bar(const PictureSources& sources, Region region) {
  return {kBarLeft, region_top(sources, static_cast<std::size_t>(region)) + 2,
          kLegendWidth - kMargin - kBarLeft, kBarHeight};
}

cv::Mat pattern_legend(const PictureSources& sources, int min_height) {
  const int needed = region_top(sources, kRegionCount);
  cv::Mat image(std::max(min_height, needed), kLegendWidth, CV_8UC3, kBackground);
  draw_head(image, sources);
  for (std::size_t r = 0; r < kRegionCount; ++r)
    if (!sources.regions[r].empty()) draw_region(image, sources, r);
  return image;
}

}  // namespace fbs::cli
