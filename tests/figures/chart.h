// Values over the pictures of a sequence.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace fbs::figures {

struct Line {
  std::string name;
  cv::Scalar colour;
  int width_px = 2;
  std::vector<double> values;  ///< at least 2, as many in each line of a chart
};

/// From 0 upwards, with a grid every `grid` units and the lines' names above; later lines lie over earlier
/// ones.
/// @param mark  index of a value to point at, or -1
[[nodiscard]] cv::Mat3b chart(const std::vector<Line>& lines, double grid, int mark, cv::Size size);

}  // namespace fbs::figures
