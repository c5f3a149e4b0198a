#include "encoder/track/head/head_appearance.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/landmarks.h"
#include "encoder/image/bilinear.h"
#include "encoder/track/head/head_tuning.h"

namespace fbs {

using namespace head_tuning;

namespace {

/// Weight of points on a triangle: the least of its corners'.
float weight_of(const HeadTriangle& t) {
  float least = 1;
  for (const std::uint16_t v : t) {
    const HeadVertex& vertex = generic_head().vertices[v];
    const bool chin = vertex.landmark >= 4 && vertex.landmark <= 12;
    if (vertex.feature >= 0 || is_eye_landmark(vertex.landmark) || chin)
      least = std::min(least, kMovingWeight);
    if (vertex.position.y < kForeheadAbove) least = std::min(least, kHairWeight);
  }
  return least;
}

/// Sums of a weighted correlation.
struct Correlation {
  double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;

  void add(double w, double x, double y) {
    n += w;
    sx += w * x;
    sy += w * y;
    sxx += w * x * x;
    syy += w * y * y;
    sxy += w * x * y;
  }
  [[nodiscard]] double value() const {
    if (n < kMinCorrelationWeight) return 0;
    const double vx = sxx - sx * sx / n, vy = syy - sy * sy / n;
    if (vx <= 0 || vy <= 0) return 0;
    return std::clamp((sxy - sx * sy / n) / std::sqrt(vx * vy), 0.0, 1.0);
  }
};

}  // namespace

HeadAppearance::HeadAppearance(const HeadVertices& neutral, const Pose& pose, const WorkFrame& first)
    : eye_distance_px_(pose.eye_distance_px()) {
  const PoseProjection projection(pose);
  points_ = spread_over_mesh(neutral, projection, kPointSpacing / first.scale);
  for (const SurfacePoint& p : points_) weight_.push_back(weight_of(p.corner));
  const LevelledFrame levelled(first);
  const std::vector<glm::dvec3> points = surface(neutral);
  if (!first.u.empty())
    for (const glm::dvec3& p : points) colour_.push_back(colour_at(first, projection(p)));
  for (int level = 0; level < LevelledFrame::kLevels; ++level) {
    for (const glm::dvec3& p : points) {
      Sample s;
      const bool inside = sample_with_slope(levelled.levels[level], levelled.at(projection(p), level), s);
      seen_[level].push_back(inside ? s.value : -1.0F);
    }
  }
}

std::optional<HeadAppearance::Colour> HeadAppearance::colour_at(const WorkFrame& frame, glm::dvec2 picture) {
  constexpr double kGrey = 128;
  const glm::dvec2 work = frame.to_work(picture);
  const cv::Point at(static_cast<int>(std::lround(work.x)), static_cast<int>(std::lround(work.y)));
  if (!cv::Rect({0, 0}, frame.luma.size()).contains(at)) return std::nullopt;
  const auto level = [&](const cv::Mat& plane) { return static_cast<double>(plane.at<std::uint8_t>(at)); };
  return Colour{level(frame.luma), level(frame.u) - kGrey, level(frame.v) - kGrey};
}

std::vector<glm::dvec3> HeadAppearance::surface(const HeadVertices& vertices) const {
  std::vector<glm::dvec3> out;
  out.reserve(points_.size());
  for (const SurfacePoint& p : points_) out.push_back(p.on(vertices));
  return out;
}

double HeadAppearance::correlation(const LevelledFrame& now, const Pose& pose,
                                   std::span<const glm::dvec3> points) const {
  constexpr int kLevel = 1;
  const LevelProjection projection(PoseProjection(pose), now.frame, kLevel);
  Correlation sums;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Sample s;
    if (seen_[kLevel][k] < 0 || !sample_with_slope(now.levels[kLevel], projection(glm::vec3(points[k])), s))
      continue;
    sums.add(static_cast<double>(weight_[k]), static_cast<double>(seen_[kLevel][k]),
             static_cast<double>(s.value));
  }
  return sums.value();
}

double HeadAppearance::colour_difference(const WorkFrame& now, const Pose& pose,
                                         std::span<const glm::dvec3> points) const {
  struct Seen {
    double weight;
    Colour first, now;
  };
  std::vector<Seen> seen;
  const PoseProjection projection(pose);
  double sum = 0, before = 0, after = 0;
  for (std::size_t k = 0; k < colour_.size(); ++k) {
    const auto colour = colour_[k] ? colour_at(now, projection(points[k])) : std::nullopt;
    if (!colour) continue;
    seen.push_back({static_cast<double>(weight_[k]), *colour_[k], *colour});
    sum += seen.back().weight;
    before += seen.back().weight * seen.back().first[0];
    after += seen.back().weight * seen.back().now[0];
  }
  if (sum < kMinCorrelationWeight || before == 0) return 0;
  const double light = after / before;  // colours are as much stronger
  double difference = 0;
  for (const Seen& s : seen)
    for (const std::size_t c : {1, 2}) difference += s.weight * std::abs(s.now[c] - light * s.first[c]);
  return difference / sum;
}

}  // namespace fbs
