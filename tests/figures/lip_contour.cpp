#include "tests/figures/lip_contour.h"

#include "encoder/track/snake/snake_descent.h"

namespace fbs {

LipContour::LipContour(const Geometry& geometry, const Pose& pose, const Picture& first, double repulsion)
    : snake_(FeatureSnake::make(FeatureId::kMouthOuter, geometry)), eye_distance_px_(pose.eye_distance_px()) {
  snake_.weights.repulsion *= repulsion;
  snake_.learn(snake_.patch(frame(first, pose), pose));
  track(first, pose);
  snake_.rest = snake_.now;
}

WorkFrame LipContour::frame(const Picture& picture, const Pose& pose) const {
  return WorkFrame::cut(picture, pose.shift, eye_distance_px_, true);
}

void LipContour::track(const Picture& picture, const Pose& pose) {
  const SnakeImage image = snake_.observe(snake_.patch(frame(picture, pose), pose));
  const BSnake energies(snake_.curve, image, snake_.weights, snake_.rest, snake_.now, snake_.facing);
  snake_.now = descend(energies, snake_.now).control;
}

double LipContour::height() const {
  // The curve runs from the right corner over the upper lip.
  const auto& points = snake_.curve.points();
  const glm::dvec2 upper = curve_point(points[points.size() / 4], snake_.now),
                   lower = curve_point(points[points.size() * 3 / 4], snake_.now);
  return (lower.y - upper.y) * kHeadUnitsPerSnakeUnit / kUnitsPerEyeDistance;
}

std::vector<glm::dvec2> LipContour::outline(const Pose& pose) const {
  const PoseProjection projection(pose);
  std::vector<glm::dvec2> out;
  for (const SplineBasis& b : snake_.curve.points())
    out.push_back(
        projection(glm::dvec3(curve_point(b, snake_.now) * kHeadUnitsPerSnakeUnit, snake_.plane.depth)));
  return out;
}

}  // namespace fbs
