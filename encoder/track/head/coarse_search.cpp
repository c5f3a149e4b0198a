#include "encoder/track/head/coarse_search.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

constexpr std::size_t kMaxPoints = 250;  // enough to rank a grid; time is proportional
constexpr int kBorder = 12;              // level pixels: an eye distance
constexpr int kStep = 2;                 // level pixels, a sixth of the eye distance

}  // namespace

CoarseCorrelation::CoarseCorrelation(const HeadAppearance& head, const HeadVertices& vertices,
                                     const LevelledFrame& now)
    : now_(now), vertices_(vertices) {
  const auto seen = head.seen(kLevel);
  const std::size_t step = std::max<std::size_t>(1, seen.size() / kMaxPoints);
  for (std::size_t k = 0; k < seen.size(); k += step) {
    if (seen[k] < 0) continue;
    const SurfacePoint& p = head.points()[k];
    points_.push_back({p.on(vertices), p.corner, seen[k], head.weights()[k]});
  }
  for (const Point& p : points_) centre_ += p.place / static_cast<double>(points_.size());
  cv::copyMakeBorder(now.levels[kLevel], level_, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT,
                     cv::Scalar(128));
}

TrackedPose CoarseCorrelation::best_place(Pose pose, double reach_px) {
  const double to_level = now_.frame.scale / level_scale(kLevel);
  const int reach = static_cast<int>(std::lround(reach_px * to_level / kStep)) * kStep;
  set_pose(pose);
  if (taps_.size() < points_.size() / 2) return {pose, 0};
  glm::ivec2 best{0, 0};
  double most = 0;
  for (int y = -reach; y <= reach; y += kStep) {
    for (int x = -reach; x <= reach; x += kStep) {
      const double c = correlation({x, y});
      if (c > most) {
        most = c;
        best = {x, y};
      }
    }
  }
  pose.shift += glm::dvec2(best) / to_level;
  return {pose, most};
}

void CoarseCorrelation::set_pose(const Pose& pose) {
  const PoseProjection projection(pose);
  taps_.clear();
  weight_ = mean_ = 0;
  low_ = {1 << 20, 1 << 20};
  high_ = {-(1 << 20), -(1 << 20)};
  for (const Point& p : points_) {
    const auto corner = [&](std::size_t i) { return projection(vertices_[p.corner[i]]); };
    const glm::dvec2 a = corner(0), e = corner(1) - a, f = corner(2) - a;
    const bool faces_viewer = e.x * f.y - e.y * f.x > 0;  // clockwise in the picture
    if (faces_viewer) add_tap(p, now_.at(projection(p.place), kLevel));
  }
  centre_taps();
}

void CoarseCorrelation::add_tap(const Point& point, glm::dvec2 at) {
  const glm::ivec2 tap{static_cast<int>(std::lround(at.x)) + kBorder,
                       static_cast<int>(std::lround(at.y)) + kBorder};
  taps_.push_back({tap, point.weight, point.seen});
  low_ = {std::min(low_.x, tap.x), std::min(low_.y, tap.y)};
  high_ = {std::max(high_.x, tap.x), std::max(high_.y, tap.y)};
  weight_ += point.weight;
  mean_ += point.weight * point.seen;
}

void CoarseCorrelation::centre_taps() {
  mean_ /= std::max(weight_, 1e-6F);
  variance_ = 0;
  for (Tap& t : taps_) {
    t.deviation -= mean_;
    variance_ += t.weight * t.deviation * t.deviation;
    t.deviation *= t.weight;
  }
}

double CoarseCorrelation::correlation(glm::ivec2 shift) const {
  if (low_.x + shift.x < 0 || low_.y + shift.y < 0 || high_.x + shift.x >= level_.cols ||
      high_.y + shift.y >= level_.rows)
    return 0;
  // The shift alone may lead outside the picture: only with a tap's position is it an address.
  const auto stride = static_cast<std::ptrdiff_t>(level_.step[0]);
  const std::ptrdiff_t origin = shift.y * stride + shift.x;
  const auto* samples = level_.ptr<std::uint8_t>();
  float common = 0, sum = 0, squares = 0;
  for (const Tap& t : taps_) {
    const auto value = static_cast<float>(samples[origin + t.at.y * stride + t.at.x]);
    common += t.deviation * value;
    sum += t.weight * value;
    squares += t.weight * value * value;
  }
  const float variance = squares - sum * sum / weight_;
  if (variance <= 0 || variance_ <= 0) return 0;
  return static_cast<double>(common / std::sqrt(variance * variance_));
}

std::vector<TrackedPose> search_coarsely(const HeadAppearance& head, const HeadVertices& vertices,
                                         const LevelledFrame& now, const Pose& centre, const PoseGrid& grid) {
  CoarseCorrelation coarse(head, vertices, now);
  const glm::dvec2 middle = PoseProjection(centre)(coarse.centre());
  std::vector<TrackedPose> out;
  for (const double yaw : grid.yaw) {
    for (const double pitch : grid.pitch) {
      for (const double size : grid.size) {
        Pose pose = centre;
        pose.yaw += yaw;
        pose.pitch += pitch;
        pose.log2_scale += size;
        pose.shift += middle - PoseProjection(pose)(coarse.centre());
        out.push_back(coarse.best_place(pose, grid.reach * centre.eye_distance_px()));
      }
    }
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.confidence > b.confidence; });
  return out;
}

}  // namespace fbs
