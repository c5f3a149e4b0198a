#include "tests/figures/chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace fbs::figures {
namespace {

constexpr int kLeft = 34, kTop = 24, kRight = 8, kBottom = 10;  // pixels round the plot
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kShift = 4;
const cv::Scalar kPaper(255, 255, 255), kGrid(225, 225, 225), kInk(90, 90, 90);

}  // namespace

cv::Mat3b chart(const std::vector<Line>& lines, double grid, int mark, cv::Size size) {
  cv::Mat3b image(size);
  image.setTo(kPaper);
  double most = grid;
  for (const Line& line : lines)
    most = std::max(most, *std::max_element(line.values.begin(), line.values.end()));
  const auto count = static_cast<double>(lines.front().values.size() - 1);
  const auto x_of = [&](double i) { return kLeft + i / count * (size.width - kLeft - kRight); };
  const auto y_of = [&](double v) {
    return size.height - kBottom - v / (1.05 * most) * (size.height - kTop - kBottom);
  };
  const auto at = [](double x, double y) {
    return cv::Point(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
  };

  for (double v = 0; v <= 1.05 * most; v += grid) {
    char label[16];
    std::snprintf(label, sizeof label, "%.1f", v);
    cv::line(image, at(kLeft, y_of(v)), at(size.width - kRight, y_of(v)), kGrid);
    cv::putText(image, label, at(4, y_of(v) + 4), kFont, 0.38, kInk, 1, cv::LINE_AA);
  }
  if (mark >= 0) cv::line(image, at(x_of(mark), kTop), at(x_of(mark), y_of(0)), kInk);

  int legend_x = kLeft;
  for (const Line& line : lines) {
    std::vector<cv::Point> points;
    for (std::size_t i = 0; i < line.values.size(); ++i)
      points.push_back(
          at(x_of(static_cast<double>(i)) * (1 << kShift), y_of(line.values[i]) * (1 << kShift)));
    cv::polylines(image, points, false, line.colour, line.width_px, cv::LINE_AA, kShift);
    cv::putText(image, line.name, {legend_x, 15}, kFont, 0.42, line.colour, 1, cv::LINE_AA);
    legend_x += cv::getTextSize(line.name, kFont, 0.42, 1, nullptr).width + 14;
  }
  return image;
}

}  // namespace fbs::figures
