#include "encoder/image/pyramid.h"

#include <cmath>
#include <vector>

namespace fbs {
namespace {

/// OpenCV's means over whole squares, which take several times as long: columns are added up first, in a loop
/// that the compiler makes vectors of.
cv::Mat1b means(const cv::Mat1b& from, int factor) {
  cv::Mat1b out(from.rows / factor, from.cols / factor);
  std::vector<std::uint32_t> columns(static_cast<std::size_t>(from.cols));
  const float share = 1.0F / static_cast<float>(factor * factor);
  for (int y = 0; y < out.rows; ++y) {
    std::ranges::fill(columns, 0U);
    for (int i = 0; i < factor; ++i) {
      const std::uint8_t* row = from[y * factor + i];
      for (std::size_t x = 0; x < columns.size(); ++x) columns[x] += row[x];
    }
    const std::uint32_t* next = columns.data();
    for (int x = 0; x < out.cols; ++x) {
      std::uint32_t sum = 0;
      for (int i = 0; i < factor; ++i) sum += *next++;
      out(y, x) = static_cast<std::uint8_t>(std::lrint(share * static_cast<float>(sum)));
    }
  }
  return out;
}

}  // namespace

cv::Mat reduced(const Plane& plane, int factor) {
  const cv::Mat1b whole = view(plane);
  if (factor == 1) return whole.clone();
  // OpenCV rounds halves up in squares of 2 x 2, and is fast.
  if (factor > 2 && whole.cols % factor == 0 && whole.rows % factor == 0) return means(whole, factor);
  cv::Mat out;
  cv::resize(whole, out, {whole.cols / factor, whole.rows / factor}, 0, 0, cv::INTER_AREA);
  return out;
}

}  // namespace fbs
