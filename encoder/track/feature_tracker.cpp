#include "encoder/track/feature_tracker.h"

#include <algorithm>
#include <cmath>

#include "encoder/model/expression_prior.h"

namespace fbs {
namespace {

/// How far the control points of the inner lips go with those of the outer lips: [inner][outer], from the
/// spread of the generic head at the inner lips' vertices.
const std::vector<std::vector<double>>& inner_lip_follow() {
  static const std::vector<std::vector<double>> table = [] {
    const GenericHead& head = generic_head();
    const Feature &inner = feature(FeatureId::kMouthInner), &outer = feature(FeatureId::kMouthOuter);
    const SnakeCurve curve = SnakeCurve::closed(inner.control_count, 32);
    std::vector<std::vector<double>> follow(inner.control_count, std::vector<double>(outer.control_count));
    for (std::size_t c = 0; c < outer.control_count; ++c) {
      std::vector<glm::dvec2> target;
      for (const FeatureVertex& fv : inner.vertices) {
        const auto v = fv.vertex;
        double weight = 0;
        for (std::size_t k = head.skinning_begin[v]; k < head.skinning_begin[v + 1]; ++k)
          if (head.skinning[k].control == outer.first_control + static_cast<int>(c))
            weight = head.skinning[k].weight / static_cast<double>(kSkinningOne);
        target.emplace_back(weight, 0);
      }
      const auto control = fit_control(inner, curve, target, {});
      for (std::size_t i = 0; i < control.size(); ++i) follow[i][c] = control[i].x;
    }
    return follow;
  }();
  return table;
}

bool is_lid(FeatureId id) {
  return id == FeatureId::kUpperLidRight || id == FeatureId::kUpperLidLeft;
}

/// The eye shut: far below, brought back to the limit.
std::vector<glm::dvec2> shut(const FeatureSnake& s) {
  std::vector<glm::dvec2> control = s.rest;
  for (int i = s.curve.first_free(); i < s.curve.end_free(); ++i) control[i].y += 16;
  s.limit(control);
  return control;
}

}  // namespace

FeatureTracker::FeatureTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first) {
  for (std::size_t v = 0; v < kVertexCount; ++v) neutral_[v] = glm::dvec3(geometry.positions[v]);
  for (const FeatureId id : kSnakeFeatures) {
    FeatureSnake s = FeatureSnake::make(id, geometry);
    const FeaturePatch seen = s.patch(first, pose);
    s.learn(seen);
    const SnakeImage image = s.look(seen);
    // The rest shape is where the snake settles, so that its own pull on the curve cancels out of all
    // offsets.
    const SnakeOutcome settled = BSnake(s.curve, image, s.weights, s.rest, s.rest, s.facing).minimise(s.rest);
    s.rest = s.now = settled.control;
    s.iterations = settled.iterations;
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
                                                const std::array<glm::dvec2, kVertexCount>& flow) const {
  // Least squares: which offsets of the control points move the feature's vertices as the flow did.
  const PoseProjection projection(pose);
  const glm::dvec2 ex(projection.matrix[0]), ey(projection.matrix[1]);
  const double det = ex.x * ey.y - ey.x * ex.y;
  if (std::abs(det) < 1e-12) return s.now;
  const int n = s.curve.controls();
  cv::Mat1d a = cv::Mat1d::eye(n, n) * 0.15, b = cv::Mat1d::zeros(n, 2);  // what the flow leaves open stays
  for (const FeatureVertex& fv : feature(s.id).vertices) {
    const auto v = fv.vertex;
    if (std::isnan(flow[v].x)) continue;
    const SplineBasis basis = basis_at(s.curve, static_cast<double>(fv.s));
    const glm::dvec2 offset = curve_point(basis, s.now) - curve_point(basis, s.rest);
    const glm::dvec2 d = flow[v] - projection(neutral_[v] + glm::dvec3(offset * kHeadUnitsPerSnakeUnit, 0));
    const glm::dvec2 moved =
        glm::dvec2(ey.y * d.x - ey.x * d.y, -ex.y * d.x + ex.x * d.y) / (det * kHeadUnitsPerSnakeUnit);
    if (std::hypot(moved.x, moved.y) > 8)
      continue;  // a quarter of the eye distance in one picture: the flow is lost
    for (std::size_t i = 0; i < 4; ++i) {
      b(basis.control[i], 0) += basis.value[i] * moved.x;
      b(basis.control[i], 1) += basis.value[i] * moved.y;
      for (std::size_t j = 0; j < 4; ++j)
        a(basis.control[i], basis.control[j]) += basis.value[i] * basis.value[j];
    }
  }
  cv::Mat1d x;
  cv::solve(a, b, x, cv::DECOMP_CHOLESKY);
  std::vector<glm::dvec2> out = s.now;
  for (int i = s.curve.first_free(); i < s.curve.end_free(); ++i) out[i] += glm::dvec2(x(i, 0), x(i, 1));
  return out;
}

void FeatureTracker::track(const WorkFrame& now, const Pose& pose,
                           const std::array<glm::dvec2, kVertexCount>& flow) {
  for (FeatureSnake& s : snakes_) {
    const SnakeImage image = s.look(s.patch(now, pose));
    const auto rest = carried_rest(s);
    const BSnake snake(s.curve, image, s.weights, rest, s.now, s.facing);
    // A descent starts where it was, or where the flow, the outer lips or a blink may have taken it:
    // whichever fits.
    std::vector<std::vector<glm::dvec2>> starts = {s.now, predict(s, pose, flow)};
    if (s.id == FeatureId::kMouthInner) starts.push_back(rest);
    if (is_lid(s.id)) {
      starts.push_back(s.rest);
      starts.push_back(shut(s));
    }
    const auto best = std::min_element(starts.begin(), starts.end(), [&](const auto& a, const auto& b) {
      return snake.energy(a) < snake.energy(b);
    });
    const SnakeOutcome settled = snake.minimise(*best);
    s.now = settled.control;
    s.limit(s.now);
    s.iterations = settled.iterations;
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
      const glm::dvec2 p =
          curve_point(basis_at(s.curve, static_cast<double>(fv.s)), s.now) - glm::dvec2(0, s.below_vertices);
      out.emplace_back(fv.vertex, glm::dvec3(p * kHeadUnitsPerSnakeUnit, s.depth));
    }
  }
  return out;
}

std::vector<glm::dvec3> FeatureTracker::outline(std::size_t snake) const {
  const FeatureSnake& s = snakes_[snake];
  std::vector<glm::dvec3> out;
  for (const SplineBasis& b : s.curve.points())
    out.emplace_back(curve_point(b, s.now) * kHeadUnitsPerSnakeUnit, s.depth);
  return out;
}

}  // namespace fbs
