#include "encoder/track/snake/snake_curve.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/track/snake/toy_snake.h"

namespace fbs {
namespace {

TEST(SnakeCurve, PointsAreEvenInTheParameter) {
  EXPECT_NEAR(SnakeCurve::closed(kControls, kPoints).ds() * kPoints, kControls, 1e-12);
  EXPECT_NEAR(SnakeCurve::clamped(13).ds() * 12, 1, 1e-12);
}

// So that sums over the points need no loop over them.
TEST(SnakeCurve, GramMatricesGiveSumsOverThePoints) {
  const SnakeCurve curve = SnakeCurve::closed(kControls, kPoints);
  const Control c = ellipse({15, 7}, {1, 2});
  for (int derivative = 0; derivative < 3; ++derivative) {
    double from_points = 0, from_gram = 0;
    for (const SplineBasis& b : curve.points()) {
      const auto& weight = derivative == 0 ? b.value : derivative == 1 ? b.d1 : b.d2;
      glm::dvec2 v(0);
      for (std::size_t k = 0; k < 4; ++k) v += weight[k] * c[b.control[k]];
      from_points += v.x * v.x;
    }
    for (std::size_t i = 0; i < kControls; ++i)
      for (std::size_t j = 0; j < kControls; ++j)
        from_gram += c[i].x * curve.gram(derivative)[i * kControls + j] * c[j].x;
    EXPECT_NEAR(from_gram, from_points, 1e-9 * from_points) << derivative;
  }
}

TEST(SnakeCurve, QuadsAreThePointsOnceMore) {
  for (const SnakeCurve& curve : {SnakeCurve::closed(kControls, kPoints), SnakeCurve::clamped(13)}) {
    std::size_t h = 0;
    for (const PointQuad& q : curve.quads()) {
      for (std::size_t l = 0; l < 4 && q.weight[l] == 1; ++l, ++h) {
        ASSERT_LT(h, curve.points().size());
        EXPECT_EQ(q.control, curve.points()[h].control);
        for (std::size_t k = 0; k < 4; ++k) EXPECT_FLOAT_EQ(q.value[k][l], curve.points()[h].value[k]);
      }
    }
    EXPECT_EQ(h, curve.points().size());
  }
}

TEST(SnakeCurve, BasisAtAParameterIsThatOfThePointThere) {
  for (const SnakeCurve& curve : {SnakeCurve::closed(kControls, kPoints), SnakeCurve::clamped(13)}) {
    const SplineBasis basis = basis_at(curve, 5 * curve.ds());
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(basis.value[k], curve.points()[5].value[k], 1e-12);
  }
}

TEST(SnakeCurve, ClampedCurvesMayBePinned) {
  EXPECT_EQ(SnakeCurve::clamped(11, false).first_free(), 1);
  EXPECT_EQ(SnakeCurve::clamped(11, false).end_free(), 3);
  EXPECT_EQ(SnakeCurve::clamped(11).end_free(), 4);
  EXPECT_FALSE(SnakeCurve::clamped(11).is_closed());
}

}  // namespace
}  // namespace fbs
