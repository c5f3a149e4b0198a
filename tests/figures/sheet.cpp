#include "tests/figures/sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace fbs::figures {
namespace {

constexpr int kGutter = 6, kMargin = 8, kCaption = 22;  // pixels
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontScale = 0.44;
const cv::Scalar kInk(50, 50, 50), kPaper(255, 255, 255);

bool has_captions(const std::vector<Panel>& row) {
  return std::any_of(row.begin(), row.end(), [](const Panel& p) { return !p.caption.empty(); });
}

cv::Size size_of(const std::vector<Panel>& row) {
  cv::Size size(-kGutter, 0);
  for (const Panel& p : row) {
    size.width += p.image.cols + kGutter;
    size.height = std::max(size.height, p.image.rows);
  }
  if (has_captions(row)) size.height += kCaption;
  return size;
}

/// In the middle under its panel, smaller when it would not fit.
void write_caption(cv::Mat3b& paper, const Panel& panel, cv::Point corner) {
  int base = 0;
  double scale = kFontScale;
  cv::Size text = cv::getTextSize(panel.caption, kFont, scale, 1, &base);
  if (text.width > panel.image.cols) {
    scale *= static_cast<double>(panel.image.cols) / text.width;
    text = cv::getTextSize(panel.caption, kFont, scale, 1, &base);
  }
  cv::putText(paper, panel.caption, corner + cv::Point((panel.image.cols - text.width) / 2, 15), kFont, scale,
              kInk, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat3b sheet(const std::vector<std::vector<Panel>>& rows) {
  cv::Size size(0, -kGutter);
  for (const auto& row : rows) {
    size.width = std::max(size.width, size_of(row).width);
    size.height += size_of(row).height + kGutter;
  }
  cv::Mat3b paper(size.height + 2 * kMargin, size.width + 2 * kMargin);
  paper.setTo(kPaper);
  int y = kMargin;
  for (const auto& row : rows) {
    int x = kMargin;
    for (const Panel& p : row) {
      p.image.copyTo(paper(cv::Rect({x, y}, p.image.size())));
      write_caption(paper, p, {x, y + p.image.rows});
      x += p.image.cols + kGutter;
    }
    y += size_of(row).height + kGutter;
  }
  return paper;
}

std::string letter(int index) {
  return {'(', static_cast<char>('a' + index), ')', ' '};
}

}  // namespace fbs::figures
