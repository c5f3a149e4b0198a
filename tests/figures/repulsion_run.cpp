#include "tests/figures/repulsion_run.h"

#include <algorithm>
#include <cmath>

#include "tests/figures/canvas.h"
#include "tests/figures/chart.h"
#include "tests/figures/lip_contour.h"
#include "tests/figures/painted_mouth.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 300;    // pixels
constexpr double kPapersRate = 12;  // pictures/s
constexpr double kSame = 0.02;      // eye distances; less is no difference
constexpr double kTeeth = 0.9;      // of the gap
constexpr double kClosing = 0.03;   // eye distances a picture
const cv::Scalar kTrue(170, 170, 170), kWithout(60, 60, 230), kWith(200, 130, 30);

/// Both contours side by side.
class Race {
 public:
  Race(const Geometry& geometry, const Pose& pose, const Picture& first)
      : without_(geometry, pose, first, 0), with_(geometry, pose, first, 1) {
    note(0, pose);
  }

  void track(int number, const Picture& picture, const Pose& pose) {
    without_.track(picture, pose);
    with_.track(picture, pose);
    note(number, pose);
  }

  [[nodiscard]] RepulsionRun run() && { return std::move(run_); }

 private:
  void note(int number, const Pose& pose) {
    run_.pictures.push_back(number);
    run_.outline_without.push_back(without_.outline(pose));
    run_.outline_with.push_back(with_.outline(pose));
    run_.height_without.push_back(without_.height());
    run_.height_with.push_back(with_.height());
  }

  LipContour without_, with_;
  RepulsionRun run_;
};

}  // namespace

std::size_t RepulsionRun::most_telling() const {
  std::size_t differs = 0, opened = 0;
  const auto difference = [&](std::size_t i) { return height_with[i] - height_without[i]; };
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    if (difference(i) > difference(differs)) differs = i;
    if (height_with[i] > height_with[opened]) opened = i;
  }
  return difference(differs) > kSame ? differs : opened;
}

TeethHeights RepulsionRun::heights_at(std::size_t at, const std::vector<double>& truth) const {
  return {truth.empty() ? 0.0 : truth[at], height_without[at], height_with[at]};
}

Panel RepulsionRun::panel(const Picture& picture, const VideoFormat& format, const cv::Rect2d& part,
                          std::size_t at, bool with, std::string caption) const {
  Canvas canvas(picture, format, part, kPanelWidth);
  canvas.curve(with ? outline_with[at] : outline_without[at], true, kOuterLips);
  return {canvas.image(), std::move(caption)};
}

Panel RepulsionRun::height_panel(const std::vector<double>& truth, std::size_t at,
                                 std::string caption) const {
  std::vector<Line> lines;
  if (!truth.empty()) lines.push_back({"true", kTrue, 2, truth});
  lines.push_back({"with repulsion", kWith, 3, height_with});
  lines.push_back({"without", kWithout, 1, height_without});  // thin and last: both are seen where they agree
  return {chart(lines, 0.2, static_cast<int>(at), {kPanelWidth, kPanelWidth * 3 / 4}), std::move(caption)};
}

RepulsionRun run_at_papers_rate(const Footage& footage, const Followed& followed) {
  const Rational rate = footage.format.frame_rate;
  const auto step = static_cast<std::size_t>(
      std::max(1L, std::lround(static_cast<double>(rate.num) / rate.den / kPapersRate)));
  Race race(followed.geometry(), followed.pose(0), footage.pictures.front());
  for (std::size_t i = step; i < footage.pictures.size(); i += step)
    race.track(static_cast<int>(i), footage.pictures[i], followed.pose(i));
  return std::move(race).run();
}

PaintedRun run_painted_mouth(double step) {
  std::vector<double> open = {0, 0};
  while (open.back() < kPaintedOpen) open.push_back(std::min(kPaintedOpen, open.back() + step));
  open.insert(open.end(), 2, kPaintedOpen);
  PaintedRun out;
  out.open_at = open.size() - 1;
  while (open.back() > 0) open.push_back(std::max(0.0, open.back() - kClosing));
  open.insert(open.end(), 2, 0.0);

  for (const double o : open) {
    out.pictures.push_back(painted_mouth(o, kTeeth));
    out.truth.push_back(painted_height(o));
  }
  const Pose pose = painted_pose();
  Race race(painted_geometry(), pose, out.pictures.front());
  for (std::size_t i = 1; i < out.pictures.size(); ++i)
    race.track(static_cast<int>(i), out.pictures[i], pose);
  out.run = std::move(race).run();
  return out;
}

cv::Rect2d part_around(const std::vector<glm::dvec2>& points, double width) {
  const auto [x0, x1] = std::ranges::minmax(points, {}, &glm::dvec2::x);
  const auto [y0, y1] = std::ranges::minmax(points, {}, &glm::dvec2::y);
  const double height = width * 3 / 4;
  return {(x0.x + x1.x - width) / 2, (y0.y + y1.y - height) / 2, width, height};
}

}  // namespace fbs::figures
