#include "encoder/track/feature_tracker.h"

#include <algorithm>
#include <cmath>

#include "encoder/model/expression_prior.h"
#include "encoder/model/skinning.h"
#include "encoder/track/snake/control_fit.h"
#include "encoder/track/snake/inner_lip_follow.h"
#include "encoder/track/snake/snake_descent.h"

namespace fbs {
namespace {

constexpr double kStay = 0.15;       // weight per control point where the flow leaves it open
constexpr double kMaxFlow = 8;       // snake units, a quarter of the eye distance: beyond, the flow is lost
constexpr double kShutLid = 16;      // snake units, farther than any lid travels
constexpr double kSingular = 1e-12;  // determinant of a pose seen edge-on

/// The eye shut: moved far below, then limited.
std::vector<glm::dvec2> shut(const FeatureSnake& s) {
  std::vector<glm::dvec2> control = s.rest;
  for (int i = s.curve.first_free(); i < s.curve.end_free(); ++i) control[i].y += kShutLid;
  s.limit(control);
  return control;
}

}  // namespace

FeatureTracker::FeatureTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first,
                               bool descends)
    : descends_(descends), neutral_(skinned(geometry, {})) {
  for (const FeatureId id : kSnakeFeatures) {
    FeatureSnake s = FeatureSnake::make(id, geometry);
    const FeaturePatch seen = s.patch(first, pose);
    s.learn(seen);
    const SnakeImage image = s.observe(seen);
    // The rest shape is where the descent ends, so that the snake's own pull on the curve cancels out of all
    // offsets.
    const SnakeOutcome outcome = descend(BSnake(s.curve, image, s.weights, s.rest, s.rest, s.facing), s.rest);
    s.rest = s.now = outcome.control;
    s.iterations = outcome.iterations;
    snakes_.push_back(std::move(s));
  }
}

std::vector<glm::dvec2> FeatureTracker::carried_rest(const FeatureSnake& s) const {
  std::vector<glm::dvec2> rest = s.rest;
  if (s.id != FeatureId::kMouthInner) return rest;
  const FeatureSnake& outer = snakes_.front();
  const auto& follow = inner_lip_follow();
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (std::size_t c = 0; c < outer.now.size(); ++c)
      rest[i] += follow[i][c] * (outer.now[c] - outer.rest[c]);
  return rest;
}

std::vector<glm::dvec2> FeatureTracker::predict(const FeatureSnake& s, const Pose& pose,
                                                const MeshFlow& flow) const {
  // Least squares for the offsets of the control points that move the feature's vertices as the flow did.
  const PoseProjection projection(pose);
  const glm::dvec2 ex(projection.matrix[0]), ey(projection.matrix[1]);
  const double det = ex.x * ey.y - ey.x * ex.y;
  if (std::abs(det) < kSingular) return s.now;
  ControlFit fit(s.curve.controls());
  for (int i = 0; i < s.curve.controls(); ++i) fit.add(i, kStay, {0, 0});
  for (const FeatureVertex& fv : feature(s.id).vertices) {
    const auto v = fv.vertex;
    if (std::isnan(flow[v].x)) continue;
    const glm::dvec2 offset = s.at(fv, s.now) - s.at(fv, s.rest);
    const glm::dvec2 d = flow[v] - projection(neutral_[v] + glm::dvec3(offset * kHeadUnitsPerSnakeUnit, 0));
    const glm::dvec2 moved =
        glm::dvec2(ey.y * d.x - ey.x * d.y, -ex.y * d.x + ex.x * d.y) / (det * kHeadUnitsPerSnakeUnit);
    if (std::hypot(moved.x, moved.y) > kMaxFlow) continue;
    const SplineBasis basis = basis_at(s.curve, static_cast<double>(fv.s));
    fit.add(basis, basis.value, 1, moved);
  }
  const std::vector<glm::dvec2> x = fit.solve();
  std::vector<glm::dvec2> out = s.now;
  for (int i = s.curve.first_free(); i < s.curve.end_free(); ++i) out[i] += x[i];
  return out;
}

std::vector<std::vector<glm::dvec2>> FeatureTracker::starts(const FeatureSnake& s, const Pose& pose,
                                                            const MeshFlow& flow,
                                                            const std::vector<glm::dvec2>& rest) const {
  std::vector<std::vector<glm::dvec2>> out = {s.now, predict(s, pose, flow)};
  if (s.id == FeatureId::kMouthInner) out.push_back(rest);
  if (is_upper_lid(s.id)) {
    out.push_back(s.rest);
    out.push_back(shut(s));
  }
  return out;
}

void FeatureTracker::track(const WorkFrame& now, const Pose& pose, const MeshFlow& flow) {
  for (FeatureSnake& s : snakes_) {
    const SnakeImage image = s.observe(s.patch(now, pose));
    const auto rest = carried_rest(s);
    const BSnake snake(s.curve, image, s.weights, rest, s.now, s.facing);
    // A descent starts where the curve was, or where the flow, the outer lips or a blink may have taken it:
    // the best fit wins.
    const auto from = starts(s, pose, flow, rest);
    const auto best = std::min_element(from.begin(), from.end(), [&](const auto& a, const auto& b) {
      return snake.energy(a) < snake.energy(b);
    });
    const SnakeOutcome outcome = descends_ ? descend(snake, *best) : SnakeOutcome{*best, 0, 0, 0};
    s.now = outcome.control;
    s.limit(s.now);
    s.iterations = outcome.iterations;
  }
  set_offsets(most_probable(offsets()));
}

std::array<glm::dvec2, kControlCount> FeatureTracker::offsets() const {
  std::array<glm::dvec2, kControlCount> out{};
  for (const FeatureSnake& s : snakes_) {
    const auto rest = carried_rest(s);
    auto to = out.begin() + feature(s.id).first_control;
    for (int i = s.curve.first_free(); i < s.curve.end_free(); ++i)
      *to++ = (s.now[i] - rest[i]) * kHeadUnitsPerSnakeUnit;
  }
  return out;
}

void FeatureTracker::set_offsets(const std::array<glm::dvec2, kControlCount>& offsets) {
  for (FeatureSnake& s : snakes_) {
    const auto rest = carried_rest(s);
    auto from = offsets.begin() + feature(s.id).first_control;
    for (int i = s.curve.first_free(); i < s.curve.end_free(); ++i)
      s.now[i] = rest[i] + *from++ / kHeadUnitsPerSnakeUnit;
  }
}

std::vector<std::pair<std::size_t, glm::dvec3>> FeatureTracker::vertices() const {
  std::vector<std::pair<std::size_t, glm::dvec3>> out;
  for (const FeatureSnake& s : snakes_) {
    for (const FeatureVertex& fv : feature(s.id).vertices) {
      const glm::dvec2 p = s.at(fv, s.now) - glm::dvec2(0, s.below_vertices);
      out.emplace_back(fv.vertex, glm::dvec3(p * kHeadUnitsPerSnakeUnit, s.plane.depth));
    }
  }
  return out;
}

std::vector<glm::dvec3> FeatureTracker::outline(std::size_t snake) const {
  const FeatureSnake& s = snakes_[snake];
  std::vector<glm::dvec3> out;
  for (const SplineBasis& b : s.curve.points())
    out.emplace_back(curve_point(b, s.now) * kHeadUnitsPerSnakeUnit, s.plane.depth);
  return out;
}

}  // namespace fbs
