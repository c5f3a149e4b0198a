#include <algorithm>
#include <cmath>

#include "tests/figures/canvas.h"
#include "tests/figures/figures.h"
#include "tests/figures/painted_mouth.h"
#include "tests/figures/repulsion_run.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 300;       // pixels
constexpr double kSlowOpening = 0.03;  // of the painted mouth, eye distances a picture
constexpr double kPartWidth = 1.3;     // of the picture that a panel shows, eye distances

Panel brow_panel(const Footage& footage, const Followed& followed, int picture) {
  const auto i = static_cast<std::size_t>(picture);
  const auto& brow = snake_of(followed.analysis[i], FeatureId::kBrowRight);
  const auto& lid = snake_of(followed.analysis[i], FeatureId::kUpperLidRight);
  std::vector<glm::dvec2> both = brow;
  both.insert(both.end(), lid.begin(), lid.end());
  Canvas canvas(footage.pictures[i], footage.format,
                part_around(both, kPartWidth * followed.pose(i).eye_distance_px()), kPanelWidth);
  canvas.curve(brow, false, kBrows);
  canvas.curve(lid, false, kLids);
  return {canvas.image(), "(c) brow and upper lid, picture " + std::to_string(picture)};
}

Panel mouth_panel(const Footage& footage, const Followed& followed, int picture, std::string caption) {
  const auto i = static_cast<std::size_t>(picture);
  const auto& outer = snake_of(followed.analysis[i], FeatureId::kMouthOuter);
  Canvas canvas(footage.pictures[i], footage.format,
                part_around(outer, kPartWidth * followed.pose(i).eye_distance_px()), kPanelWidth);
  canvas.curve(outer, true, kOuterLips);
  canvas.curve(snake_of(followed.analysis[i], FeatureId::kMouthInner), true, kInnerLips);
  return {canvas.image(), caption + ", picture " + std::to_string(picture)};
}

/// True heights of the outer lips at a run's pictures, eye distances; empty when unknown.
std::vector<double> true_heights(const Footage& footage, const RepulsionRun& run) {
  std::vector<double> out;
  if (footage.truth.empty()) return out;
  for (const int i : run.pictures) out.push_back(face_motion(footage.truth[i]).mouth_height);
  return out;
}

}  // namespace

SnakeFigure snake_figure(const Footage& footage, const Followed& followed) {
  const auto mouth = rising(measure(footage, followed, &FaceMotion::mouth_height), 2);
  const auto brow = rising(measure(footage, followed, &FaceMotion::brow_raise), 2);
  // Without truth, a mouth that the snake has lost may count as closed.
  const std::string tracked = footage.truth.empty() ? " as tracked" : "";
  const std::vector<Panel> snakes = {mouth_panel(footage, followed, mouth.front(), "(a) closed" + tracked),
                                     mouth_panel(footage, followed, mouth.back(), "(b) opened" + tracked),
                                     brow_panel(footage, followed, brow.back())};

  const RepulsionRun run = run_at_papers_rate(footage, followed);
  const std::size_t at = run.most_telling();
  const auto i = static_cast<std::size_t>(run.pictures[at]);
  auto both = run.outline_without[at];  // so that both panels show the same part
  both.insert(both.end(), run.outline_with[at].begin(), run.outline_with[at].end());
  const cv::Rect2d part = part_around(both, kPartWidth * followed.pose(i).eye_distance_px());
  const auto truth = true_heights(footage, run);
  const std::string where = " repulsion, picture " + std::to_string(i);
  return {sheet({snakes,
                 {run.panel(footage.pictures[i], footage.format, part, at, false, "(d) without" + where),
                  run.panel(footage.pictures[i], footage.format, part, at, true, "(e) with" + where),
                  run.height_panel(truth, at, "(f) height of the lips, eye distances")}}),
          run.heights_at(at, truth)};
}

SnakeFigure painted_snake_figure() {
  const PaintedRun fast = run_painted_mouth(kPaintedOpen), slow = run_painted_mouth(kSlowOpening);
  VideoFormat format;
  format.matrix = ColourMatrix::kBt601;
  // The correct curve of the open mouth tells which part of the picture to show.
  const cv::Rect2d part =
      part_around(slow.run.outline_with[slow.open_at], kPartWidth * painted_pose().eye_distance_px());
  const auto panel = [&](const PaintedRun& painted, std::size_t at, bool with, std::string caption) {
    return painted.run.panel(painted.pictures[at], format, part, at, with, std::move(caption));
  };
  return {
      sheet({{panel(fast, 0, true, "(a) painted mouth, closed"),
              panel(fast, fast.open_at, false, "(b) opened at once, without repulsion"),
              panel(fast, fast.open_at, true, "(c) opened at once, with repulsion")},
             {panel(slow, slow.open_at, false, "(d) opened slowly, without repulsion"),
              panel(slow, slow.open_at, true, "(e) opened slowly, with repulsion"),
              fast.run.height_panel(fast.truth, fast.open_at, "(f) height, opened at once, eye distances")}}),
      fast.run.heights_at(fast.open_at, fast.truth)};
}

}  // namespace fbs::figures
