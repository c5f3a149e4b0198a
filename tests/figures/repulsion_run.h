// The lips' snake alone through a sequence, once without and once with the repulsion of upper and lower lip.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {

struct RepulsionRun {
  std::vector<int> pictures;                                           ///< numbers of those that were tracked
  std::vector<std::vector<glm::dvec2>> outline_without, outline_with;  ///< of each, pixels
  std::vector<double> height_without, height_with;                     ///< of each, eye distances

  /// Index into `pictures`: where the two heights differ most, or where the mouth is opened most when they do
  /// not.
  [[nodiscard]] std::size_t most_telling() const;
  /// @param truth  of each picture, or empty
  [[nodiscard]] TeethHeights heights_at(std::size_t at, const std::vector<double>& truth) const;

  /// The picture with the outline that the run has at `at`.
  [[nodiscard]] Panel panel(const Picture& picture, const VideoFormat& format, const cv::Rect2d& part,
                            std::size_t at, bool with, std::string caption) const;
  /// Heights over time; `at` is marked.
  [[nodiscard]] Panel height_panel(const std::vector<double>& truth, std::size_t at,
                                   std::string caption) const;
};

/// The paper's 12 pictures per second: at 30 the lips part slowly enough for the snake to follow without
/// help.
[[nodiscard]] RepulsionRun run_at_papers_rate(const Footage& footage, const Followed& followed);

/// The painted mouth as it opens, stays open for a moment and shuts slowly, teeth in it.
struct PaintedRun {
  RepulsionRun run;
  std::vector<Picture> pictures;
  std::vector<double> truth;  ///< heights, eye distances
  std::size_t open_at = 0;    ///< the last picture of the open mouth
};
/// @param step  how much farther it opens from one picture to the next, eye distances
[[nodiscard]] PaintedRun run_painted_mouth(double step);
inline constexpr double kPaintedOpen = 0.40;  ///< how far it opens, eye distances; rarely exceeded in speech

/// 4 : 3 about the middle of points.
[[nodiscard]] cv::Rect2d part_around(const std::vector<glm::dvec2>& points, double width);

}  // namespace fbs::figures
