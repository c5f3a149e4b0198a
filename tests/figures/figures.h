// The paper's figures, drawn by this codec. Figure 2 needs no footage, the others one each.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

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

/// Figure 2: the generic wire-frame, front and side view.
[[nodiscard]] cv::Mat3b wire_frame_figure();

/// Figure 3: (a) source, (b) reference points, (c) scaled wire-frame, (d) adapted wire-frame.
[[nodiscard]] Result<cv::Mat3b> adaptation_figure(const Footage& footage, const Followed& followed);

/// Figure 4: the head turned and deformed as from a keyboard, wire-frames above patterned heads.
/// @param paper  as Paths::paper
[[nodiscard]] Result<cv::Mat3b> animation_figure(const Footage& footage, const Followed& paper);

/// A footage coded by the paper's own path, and with the encoder's defaults.
struct Paths {
  Followed paper, fitted;
};

/// The pictures of Figure 5.
inline constexpr int kMouthPictures = 4;
[[nodiscard]] std::vector<int> mouth_pictures(const Footage& footage, const Paths& paths);

/// Figure 5: the mouth opens. Sources with their snakes, below them the synthesised pictures of both paths.
[[nodiscard]] Result<cv::Mat3b> mouth_figure(const Footage& footage, const Paths& paths);

/// Figure 6: the brows rise, and a blink.
[[nodiscard]] Result<cv::Mat3b> brow_figure(const Footage& footage, const Paths& paths);

/// Figure 7: pictures of Figure 5 turned, their deformations on another wire-frame and pattern, and another
/// pattern on the same wire-frame.
/// @param other  stream of somebody whose pattern takes over the motion, on a wire-frame of its own
struct SynthesisFigure {
  cv::Mat3b image;
  std::array<double, 2> own, other;  ///< between the inner lips at Fig. 5 (a) and (e), eye distances
};
[[nodiscard]] Result<SynthesisFigure> synthesis_figure(const Footage& footage, const Paths& paths,
                                                       std::span<const std::uint8_t> other);

}  // namespace fbs::figures
