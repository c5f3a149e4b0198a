#include "encoder/model/expression_prior.h"

#include <cmath>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace fbs {
namespace {

constexpr int kControls = static_cast<int>(kExpressionControls);
// Standard deviations, eye distances; set by hand. Smaller: fewer odd shapes, less individual expression.
constexpr double kControlSigma = 0.008;  // of a control point about the span of the actions
constexpr double kOuterLipTrackSigma = 0.02, kInnerLipTrackSigma = 0.02,
                 kBrowTrackSigma = 0.03;  // of contours

/// Position of a vertex on lips or brows, in the coordinates of the actions.
struct Place {
  FeatureId feature;
  bool upper = false;   ///< lip
  double across = 0;    ///< lips: -1 at the subject's right corner, 1 at the left
  double outwards = 0;  ///< brows: 0 at the inner end, 1 at the outer
  double side = 0;      ///< brows: -1 the subject's right, 1 the left

  [[nodiscard]] bool is_brow() const {
    return feature == FeatureId::kBrowRight || feature == FeatureId::kBrowLeft;
  }
  [[nodiscard]] bool is_outer_lip() const { return feature == FeatureId::kMouthOuter; }
  /// 0 at the mouth's corners, 1 in its middle.
  [[nodiscard]] double middle() const { return 1 - across * across; }
};

/// How far a point moves in one standard deviation of an action, eye distances.
using Action = std::function<glm::dvec2(const Place&)>;

Action of_lips(Action action) {
  return [action = std::move(action)](const Place& p) { return p.is_brow() ? glm::dvec2(0) : action(p); };
}

Action of_brows(Action action) {
  return [action = std::move(action)](const Place& p) { return p.is_brow() ? action(p) : glm::dvec2(0); };
}

const std::vector<Action>& actions() {
  static const std::vector<Action> all = {
      // The jaw drops; the corners move in and down a little.
      of_lips([](const Place& p) {
        return 0.15 * glm::dvec2(-0.12 * p.across, p.upper ? 0.2 * (1 - p.middle()) : 0.2 + 0.8 * p.middle());
      }),
      // The upper lip rises.
      of_lips([](const Place& p) { return glm::dvec2(0, p.upper ? -0.045 * p.middle() : 0); }),
      // The corners part, or come together to a pout.
      of_lips([](const Place& p) { return glm::dvec2(0.06 * p.across, 0); }),
      // A smile: corners up and out.
      of_lips([](const Place& p) { return (1 - p.middle()) * glm::dvec2(0.02 * p.across, -0.045); }),
      // Either lip grows thicker or rolls in.
      of_lips(
          [](const Place& p) { return glm::dvec2(0, !p.upper && p.is_outer_lip() ? 0.03 * p.middle() : 0); }),
      of_lips([](const Place& p) {
        return glm::dvec2(0, p.upper && p.is_outer_lip() ? -0.025 * p.middle() : 0);
      }),
      // The whole mouth moves sideways, up and down, or tilts.
      of_lips([](const Place&) { return glm::dvec2(0.02, 0); }),
      of_lips([](const Place&) { return glm::dvec2(0, 0.035); }),
      of_lips([](const Place& p) { return glm::dvec2(0, 0.02 * p.across); }),
      // The opening is wider or narrower than the outer lips.
      of_lips([](const Place& p) { return glm::dvec2(p.is_outer_lip() ? 0 : 0.02 * p.across, 0); }),
      // Both brows rise, their inner or their outer ends more; a frown brings them down and together.
      of_brows([](const Place&) { return glm::dvec2(0, -0.06); }),
      of_brows([](const Place& p) { return glm::dvec2(0, -0.03 * (1 - p.outwards)); }),
      of_brows([](const Place& p) { return glm::dvec2(0, -0.02 * p.outwards); }),
      of_brows([](const Place& p) { return (1 - p.outwards) * glm::dvec2(-0.03 * p.side, 0.02); }),
      // One brow rises and the other does not.
      of_brows([](const Place& p) { return glm::dvec2(0, -0.02 * p.side); }),
  };
  return all;
}

Place place_of(const GenericHead& head, FeatureId id, std::size_t v) {
  const auto at = [&](std::size_t landmark) { return head.vertices[vertex_of_landmark(landmark)].position; };
  const HeadVertex& vertex = head.vertices[v];
  Place p{.feature = id};
  if (p.is_brow()) {
    p.side = id == FeatureId::kBrowLeft ? 1 : -1;
    p.outwards = (std::abs(vertex.position.x) - at(22).x) / static_cast<double>(at(26).x - at(22).x);
  } else {
    p.across = vertex.position.x / static_cast<double>(at(54).x);
    p.upper = vertex.landmark <= 54 || (vertex.landmark >= 60 && vertex.landmark <= 64);
  }
  return p;
}

cv::Mat1d precision() {
  const GenericHead& head = generic_head();
  std::vector<std::size_t> vertices;
  std::vector<Place> places;
  for (const FeatureId id :
       {FeatureId::kMouthOuter, FeatureId::kMouthInner, FeatureId::kBrowRight, FeatureId::kBrowLeft}) {
    for (const FeatureVertex& fv : feature(id).vertices) {
      vertices.push_back(fv.vertex);
      places.push_back(place_of(head, id, vertices.back()));
    }
  }
  // How these vertices follow the control points; the same for x and y.
  const int n = static_cast<int>(vertices.size());
  cv::Mat1d follow(n, kControls, 0.0);
  for (int i = 0; i < n; ++i)
    for (const SkinningWeight& skinning : skinning_of(vertices[i]))
      if (skinning.control < kControls)
        follow(i, skinning.control) = skinning.weight / static_cast<double>(kSkinningOne);
  // An action in control points: the least-squares offsets that give the vertices its motion.
  const cv::Mat1d normal(follow.t() * follow + 1e-3 * cv::Mat1d::eye(kControls, kControls));
  cv::Mat1d covariance(kControlSigma * kControlSigma * cv::Mat1d::eye(2 * kControls, 2 * kControls));
  for (const Action& action : actions()) {
    cv::Mat1d moved(n, 2), offsets;
    for (int i = 0; i < n; ++i) {
      const glm::dvec2 d = action(places[i]);
      moved(i, 0) = d.x;
      moved(i, 1) = d.y;
    }
    cv::solve(normal, follow.t() * moved, offsets, cv::DECOMP_CHOLESKY);
    const cv::Mat1d mode = offsets.reshape(1, 2 * kControls);
    covariance += mode * mode.t();
  }
  return cv::Mat1d(covariance.inv(cv::DECOMP_CHOLESKY));
}

/// Tracked offsets to most probable ones: (P + W)^-1 W, with the inverse variances W of the tracked contours.
cv::Mat1d filter() {
  cv::Mat1d tracked(2 * kControls, 2 * kControls, 0.0);
  const int inner = feature(FeatureId::kMouthInner).first_control;
  const int brows = feature(FeatureId::kBrowRight).first_control;
  for (int i = 0; i < tracked.rows; ++i) {
    const double sigma = i / 2 < inner   ? kOuterLipTrackSigma
                         : i / 2 < brows ? kInnerLipTrackSigma
                                         : kBrowTrackSigma;
    tracked(i, i) = 1 / (sigma * sigma);
  }
  const cv::Mat1d sum(expression_precision() + tracked);
  return cv::Mat1d(sum.inv(cv::DECOMP_CHOLESKY) * tracked);
}

}  // namespace

const cv::Mat1d& expression_precision() {
  static const cv::Mat1d matrix = precision();
  return matrix;
}

std::array<glm::dvec2, kControlCount> most_probable(const std::array<glm::dvec2, kControlCount>& tracked) {
  static const cv::Mat1d matrix = filter();
  std::array<glm::dvec2, kControlCount> out = tracked;
  for (std::size_t i = 0; i < kExpressionControls; ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      const double* row = matrix[2 * static_cast<int>(i) + axis];
      double sum = 0;
      for (std::size_t j = 0; j < kExpressionControls; ++j)
        sum += row[2 * j] * tracked[j].x + row[2 * j + 1] * tracked[j].y;
      out[i][axis] = sum;
    }
  }
  return out;
}

}  // namespace fbs
