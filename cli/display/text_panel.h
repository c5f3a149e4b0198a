// Text for the viewer, on a dark ground.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>

namespace fbs::cli {

struct PanelLine {
  std::string left, right;  ///< two columns; all lines of a panel share where the second begins
};

/// In BGR, as large as the text needs. ASCII only: it is all that OpenCV's letters have.
[[nodiscard]] cv::Mat text_panel(std::span<const PanelLine> lines);

}  // namespace fbs::cli
