#include "encoder/track/snake/control_fit.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/track/snake/toy_snake.h"

namespace fbs {
namespace {

TEST(ControlFit, GivesBackTheControlPointsOfACurve) {
  const SnakeCurve curve = SnakeCurve::closed(kControls, kPoints);
  const Control wanted = ellipse({15, 7}, {1, 2});
  ControlFit fit(curve.controls());
  for (const SplineBasis& b : curve.points()) fit.add(b, b.value, 1, curve_point(b, wanted));
  const Control found = fit.solve();
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT(length(found[i] - wanted[i]), 1e-9) << i;
}

TEST(ControlFit, WeightsShareBetweenWishes) {
  ControlFit fit(1);
  fit.add(0, 3, {1, 0});
  fit.add(0, 1, {5, 8});
  EXPECT_NEAR(fit.solve()[0].x, 2, 1e-12);
  EXPECT_NEAR(fit.solve()[0].y, 2, 1e-12);
}

TEST(FitControl, CurvePassesThroughTheFeaturesVertices) {
  for (const FeatureId id : {FeatureId::kMouthOuter, FeatureId::kBrowRight}) {
    const Feature& f = feature(id);
    const SnakeCurve curve = f.closed ? SnakeCurve::closed(f.control_count, 40) : SnakeCurve::clamped(13);
    std::vector<glm::dvec2> target;
    for (const FeatureVertex& v : f.vertices) {
      const glm::ivec3 p = generic_head().vertices[v.vertex].position;
      target.emplace_back(p.x / 128.0, p.y / 128.0);
    }
    const auto control = fit_control(f, curve, target, {});
    for (std::size_t k = 0; k < target.size(); ++k) {
      const SplineBasis basis = basis_at(curve, static_cast<double>(f.vertices[k].s));
      EXPECT_LT(length(curve_point(basis, control) - target[k]), 1) << f.name << ' ' << k;
    }
  }
}

TEST(FitControl, PinnedEndsTakeTheirPlaces) {
  const Feature& f = feature(FeatureId::kUpperLidRight);
  const SnakeCurve curve = SnakeCurve::clamped(11, false);
  const std::vector<glm::dvec2> target(f.vertices.size(), glm::dvec2(0, -3));
  const auto control = fit_control(f, curve, target, {glm::dvec2(-6, 0), glm::dvec2(6, 1)});
  EXPECT_LT(length(control.front() - glm::dvec2(-6, 0)), 1e-3);
  EXPECT_LT(length(control.back() - glm::dvec2(6, 1)), 1e-3);
}

}  // namespace
}  // namespace fbs
