// A snake on paint: curves, feature maps and energies whose values can be worked out by hand.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "encoder/track/snake/snake_descent.h"

namespace fbs {

using Control = std::vector<glm::dvec2>;

inline constexpr int kControls = 10, kPoints = 40;
inline constexpr int kMaxIterations = 15;  // of one descent

inline double length(glm::dvec2 v) {
  return std::hypot(v.x, v.y);
}

/// Control points of a closed curve that runs clockwise in the picture along an ellipse about `centre`.
inline Control ellipse(glm::dvec2 radius, glm::dvec2 centre = {0, 0}) {
  Control out;
  for (int i = 0; i < kControls; ++i) {
    const double a = std::numbers::pi + 2 * std::numbers::pi * i / kControls;  // from the left, over the top
    out.push_back(centre + radius * glm::dvec2(std::cos(a), std::sin(a)));
  }
  return out;
}

inline Control circle(double radius, glm::dvec2 centre = {0, 0}) {
  return ellipse(glm::dvec2(radius), centre);
}

inline Control moved(Control c, glm::dvec2 by) {
  for (glm::dvec2& p : c) p += by;
  return c;
}

/// 80 x 80 snake units about the origin, two samples a unit.
inline constexpr double kHalf = 40, kPxPerUnit = 2;

inline cv::Mat1f painted(const std::function<double(glm::dvec2)>& paint) {
  cv::Mat1f m(static_cast<int>(2 * kHalf * kPxPerUnit), static_cast<int>(2 * kHalf * kPxPerUnit));
  for (int y = 0; y < m.rows; ++y)
    for (int x = 0; x < m.cols; ++x)
      m(y, x) = static_cast<float>(paint(glm::dvec2(x, y) / kPxPerUnit - kHalf));
  return m;
}

/// A picture without anything in it.
inline SnakeImage blank() {
  SnakeImage image;
  image.contrast_x = image.contrast_y = painted([](glm::dvec2) { return 0.0; });
  image.origin = glm::dvec2(-kHalf);
  image.px_per_unit = kPxPerUnit;
  return image;
}

/// The gradient of a feature map, per snake unit.
inline SnakeImage contrast_of(const std::function<double(glm::dvec2)>& feature) {
  SnakeImage image = blank();
  constexpr double h = 0.25;
  image.contrast_x = painted([&](glm::dvec2 p) {
    return (feature(p + glm::dvec2(h, 0)) - feature(p - glm::dvec2(h, 0))) / (2 * h);
  });
  image.contrast_y = painted([&](glm::dvec2 p) {
    return (feature(p + glm::dvec2(0, h)) - feature(p - glm::dvec2(0, h))) / (2 * h);
  });
  return image;
}

/// From 1 to 0 across a border at distance 0, over about three units either way.
inline double soft_step(double distance) {
  return 1 / (1 + std::exp(distance));
}

inline std::vector<glm::dvec2> curve_of(const SnakeCurve& curve, const Control& control) {
  std::vector<glm::dvec2> out;
  for (const SplineBasis& b : curve.points()) out.push_back(curve_point(b, control));
  return out;
}

inline double mean(const std::vector<glm::dvec2>& points, const std::function<double(glm::dvec2)>& value) {
  double sum = 0;
  for (const glm::dvec2 p : points) sum += value(p);
  return sum / static_cast<double>(points.size());
}

inline double mean_radius(const std::vector<glm::dvec2>& points) {
  return mean(points, length);
}

/// Everything a snake refers to, with one weight set at a time.
struct ToySnake {
  SnakeCurve curve = SnakeCurve::closed(kControls, kPoints);
  SnakeImage image = blank();
  SnakeWeights weights;
  Control rest = circle(10), before = circle(10);
  std::vector<FacingPair> facing;

  [[nodiscard]] BSnake snake() const { return {curve, image, weights, rest, before, facing}; }
  [[nodiscard]] SnakeOutcome minimise(const Control& start) const { return descend(snake(), start); }
  [[nodiscard]] std::vector<glm::dvec2> outline_after(const Control& start) const {
    return curve_of(curve, minimise(start).control);
  }
};

/// A line of four control points from the origin, parallel to x: v_s = (length, 0) everywhere.
inline Control line(double length_units) {
  return {{0, 0}, {length_units / 3, 0}, {2 * length_units / 3, 0}, {length_units, 0}};
}

struct ToyLine : ToySnake {
  ToyLine() {
    curve = SnakeCurve::clamped(13);
    rest = before = Control(4);
  }
  /// The sum over the points times ds, of a term that is 1 everywhere.
  static constexpr double kWhole = 13.0 / 12;
};

}  // namespace fbs
