// A figure on white paper: rows of panels with thin gutters and a caption under each panel.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace fbs::figures {

struct Panel {
  cv::Mat3b image;
  std::string caption;  ///< one line of ASCII; empty for none
};

/// Rows lie under each other, left-aligned; panels of a row may differ in width, not in height.
[[nodiscard]] cv::Mat3b sheet(const std::vector<std::vector<Panel>>& rows);

/// "(a) ", "(b) ", ...
[[nodiscard]] std::string letter(int index);

}  // namespace fbs::figures
