// The paper's figures, drawn by this codec. Figure 2 needs no footage, the others one each.
#pragma once

#include <opencv2/core.hpp>

#include "common/result.h"
#include "tests/figures/footage.h"

namespace fbs::figures {

/// Lips' height with and without repulsion where teeth appear; eye distances.
struct TeethHeights {
  double truth = 0;  ///< 0 when unknown
  double without = 0, with = 0;
};

/// Figure 1: the snakes on a closed mouth, on one opened so that teeth can be seen, and on a brow; below, the
/// lips' snake alone through that opening, without and with repulsion.
struct SnakeFigure {
  cv::Mat3b image;
  TeethHeights teeth;
};
[[nodiscard]] SnakeFigure snake_figure(const Footage& footage, const Followed& followed);

/// Also Figure 1: the painted mouth, in which only the teeth change.
[[nodiscard]] SnakeFigure painted_snake_figure();

/// Figure 2: the generic wire-frame, front and side view; hidden lines show.
[[nodiscard]] cv::Mat3b wire_frame_figure();

/// Figure 3: (a) source, (b) reference points, (c) scaled wire-frame, (d) adapted wire-frame.
[[nodiscard]] Result<cv::Mat3b> adaptation_figure(const Footage& footage, const Followed& followed);

/// Figure 5: the mouth opens. Above the sources with their snakes, below the decoded pictures.
[[nodiscard]] Result<cv::Mat3b> mouth_figure(const Footage& footage, const Followed& followed);

/// Figure 6: the brows rise, and a blink.
[[nodiscard]] Result<cv::Mat3b> brow_figure(const Footage& footage, const Followed& followed);

}  // namespace fbs::figures
