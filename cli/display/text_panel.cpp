#include "cli/display/text_panel.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace fbs::cli {
namespace {

// Pixels.
constexpr int kPanelMargin = 8;
constexpr int kPanelLine = 18;
constexpr int kPanelBaseline = 13;
constexpr int kColumnGap = 16;

constexpr double kPanelTextSize = 0.42;
const cv::Scalar kPanelBackground(32, 32, 32), kPanelText(225, 225, 225), kLeftText(130, 215, 255);

int panel_text_width(const std::string& text) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kPanelTextSize, 1, &baseline).width;
}

void write(cv::Mat& image, const std::string& text, int x, int line, const cv::Scalar& colour) {
  cv::putText(image, text, {x, kPanelMargin + line * kPanelLine + kPanelBaseline}, cv::FONT_HERSHEY_SIMPLEX,
              kPanelTextSize, colour, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat text_panel(std::span<const PanelLine> lines) {
  int left = 0, right = 0;
  for (const PanelLine& line : lines) {
    left = std::max(left, panel_text_width(line.left));
    right = std::max(right, panel_text_width(line.right));
  }
  const int column = kPanelMargin + (left > 0 ? left + kColumnGap : 0);
  cv::Mat image(2 * kPanelMargin + static_cast<int>(lines.size()) * kPanelLine, column + right + kPanelMargin,
                CV_8UC3, kPanelBackground);
  int number = 0;
  for (const PanelLine& line : lines) {
    write(image, line.left, kPanelMargin, number, kLeftText);
    write(image, line.right, column, number, kPanelText);
    ++number;
  }
  return image;
}

}  // namespace fbs::cli
