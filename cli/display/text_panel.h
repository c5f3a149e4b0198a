// Text for the viewer, on a dark background.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>

namespace fbs::cli {

struct PanelLine {
  std::string left, right;  ///< two columns; in all lines of a panel the second begins at the same place
};

/// In BGR, sized to the text. ASCII only: OpenCV's fonts have nothing else.
[[nodiscard]] cv::Mat text_panel(std::span<const PanelLine> lines);

}  // namespace fbs::cli
