#include "cli/display/text_panel.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace fbs::cli {
namespace {

// Pixels.
constexpr int kMargin = 8;
constexpr int kLine = 18;
constexpr int kBaseline = 13;
constexpr int kColumnGap = 16;

constexpr double kTextSize = 0.42;
const cv::Scalar kBackground(32, 32, 32), kText(225, 225, 225), kLeftText(130, 215, 255);

int width_of(const std::string& text) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kTextSize, 1, &baseline).width;
}

void write(cv::Mat& image, const std::string& text, int x, int line, const cv::Scalar& colour) {
  cv::putText(image, text, {x, kMargin + line * kLine + kBaseline}, cv::FONT_HERSHEY_SIMPLEX, kTextSize,
              colour, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat text_panel(std::span<const PanelLine> lines) {
  int left = 0, right = 0;
  for (const PanelLine& line : lines) {
    left = std::max(left, width_of(line.left));
    right = std::max(right, width_of(line.right));
  }
  const int column = kMargin + (left > 0 ? left + kColumnGap : 0);
  cv::Mat image(2 * kMargin + static_cast<int>(lines.size()) * kLine, column + right + kMargin, CV_8UC3,
                kBackground);
  int number = 0;
  for (const PanelLine& line : lines) {
    write(image, line.left, kMargin, number, kLeftText);
    write(image, line.right, column, number, kText);
    ++number;
  }
  return image;
}

}  // namespace fbs::cli
