#include "encoder/mouth_shape.h"

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "common/generic_head.h"

namespace fbs {
namespace {

/// A lip vertex as the actions see it.
struct LipPoint {
  double across;  // -1 at the subject's right corner, 1 at the left
  bool upper, inner;
};

/// How far a point goes in one standard deviation of an action, eye distances.
using Action = std::function<glm::dvec2(const LipPoint&)>;

double bow(const LipPoint& p) {
  return 1 - p.across * p.across;
}

const std::vector<Action>& actions() {
  static const std::vector<Action> all = {
      // the jaw drops, the corners come in and down a little
      [](const LipPoint& p) {
        return 0.15 * glm::dvec2(-0.12 * p.across, p.upper ? 0.2 * (1 - bow(p)) : 0.2 + 0.8 * bow(p));
      },
      // the upper lip is raised
      [](const LipPoint& p) { return glm::dvec2(0, p.upper ? -0.045 * bow(p) : 0); },
      // the corners go apart, or together to a pout
      [](const LipPoint& p) { return glm::dvec2(0.06 * p.across, 0); },
      // a smile: corners up and out
      [](const LipPoint& p) { return (1 - bow(p)) * glm::dvec2(0.02 * p.across, -0.045); },
      // either lip grows thicker or rolls in
      [](const LipPoint& p) { return glm::dvec2(0, !p.upper && !p.inner ? 0.03 * bow(p) : 0); },
      [](const LipPoint& p) { return glm::dvec2(0, p.upper && !p.inner ? -0.025 * bow(p) : 0); },
      // the whole mouth goes aside, up and down, or tilts
      [](const LipPoint&) { return glm::dvec2(0.02, 0); },
      [](const LipPoint&) { return glm::dvec2(0, 0.035); },
      [](const LipPoint& p) { return glm::dvec2(0, 0.02 * p.across); },
      // the opening is wider or narrower than the lips say
      [](const LipPoint& p) { return glm::dvec2(p.inner ? 0.02 * p.across : 0, 0); },
  };
  return all;
}

}  // namespace

const cv::Mat1d& mouth_precision() {
  static const cv::Mat1d precision = [] {
    constexpr double kElse = 0.008;  // eye distances that a control point moves past all actions
    const GenericHead& head = generic_head();
    const Feature &outer = feature(FeatureId::kMouthOuter), &inner = feature(FeatureId::kMouthInner);
    const int controls = outer.control_count + inner.control_count;
    CV_Assert(inner.first_control == outer.first_control + outer.control_count);
    std::vector<std::size_t> vertices;
    for (const Feature* f : {&outer, &inner})
      for (const FeatureVertex& fv : f->vertices) vertices.push_back(static_cast<std::size_t>(fv.vertex));
    // How the lips' vertices follow their control points; the same for x and y.
    const int n = static_cast<int>(vertices.size());
    cv::Mat1d follow = cv::Mat1d::zeros(n, controls);
    for (int i = 0; i < n; ++i) {
      const std::size_t v = vertices[static_cast<std::size_t>(i)];
      for (std::size_t k = head.spread_begin[v]; k < head.spread_begin[v + 1]; ++k) {
        const int c = head.spread[k].control - outer.first_control;
        if (c >= 0 && c < controls) follow(i, c) = head.spread[k].weight / static_cast<double>(kSpreadOne);
      }
    }
    const cv::Mat1d normal = follow.t() * follow + 1e-3 * cv::Mat1d::eye(controls, controls);
    cv::Mat1d covariance = kElse * kElse * cv::Mat1d::eye(2 * controls, 2 * controls);
    const auto at = [&](std::size_t v) { return head.vertices[v].position; };
    const double half = at(static_cast<std::size_t>(head.landmark_vertex[54])).x;
    for (const Action& action : actions()) {
      cv::Mat1d moved(n, 2);
      for (int i = 0; i < n; ++i) {
        const std::size_t v = vertices[static_cast<std::size_t>(i)];
        const int landmark = head.vertices[v].landmark;
        const LipPoint p{at(v).x / half, landmark <= 54 || (landmark >= 60 && landmark <= 64), landmark >= 60};
        const glm::dvec2 d = action(p);
        moved(i, 0) = d.x;
        moved(i, 1) = d.y;
      }
      cv::Mat1d offsets;
      cv::solve(normal, follow.t() * moved, offsets, cv::DECOMP_CHOLESKY);
      const cv::Mat1d mode = offsets.reshape(1, 2 * controls);
      covariance += mode * mode.t();
    }
    return cv::Mat1d(covariance.inv(cv::DECOMP_CHOLESKY));
  }();
  return precision;
}

}  // namespace fbs
