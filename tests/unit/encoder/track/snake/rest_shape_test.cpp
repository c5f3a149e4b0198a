#include "encoder/track/snake/rest_shape.h"

#include <gtest/gtest.h>

#include "encoder/track/snake/snake_kinds.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr std::array kFeatures = {FeatureId::kMouthOuter,    FeatureId::kMouthInner,
                                  FeatureId::kBrowRight,     FeatureId::kBrowLeft,
                                  FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft};

RestShape shape_of(FeatureId id) {
  return rest_shape(id, curve_of(id), toy_geometry());
}

TEST(RestShape, CurveLiesInItsPatch) {
  for (const FeatureId id : kFeatures) {
    const RestShape shape = shape_of(id);
    const cv::Rect2d& r = shape.plane.region;
    const SnakeCurve curve = curve_of(id);
    for (const SplineBasis& b : curve.points()) {
      const glm::dvec2 p = curve_point(b, shape.control);
      EXPECT_TRUE(p.x > r.x && p.y > r.y && p.x < r.x + r.width && p.y < r.y + r.height) << feature(id).name;
    }
  }
}

TEST(RestShape, BrowsRunBelowTheirMarks) {
  for (const FeatureId id : kFeatures)
    EXPECT_EQ(shape_of(id).below_vertices, is_brow(id) ? kBrowBelowMarks : 0) << feature(id).name;
}

TEST(RestShape, LidsAloneHaveALowestPlaceAndItIsBelowThem) {
  for (const FeatureId id : kFeatures) {
    const RestShape shape = shape_of(id);
    if (is_upper_lid(id)) {
      const double middle = curve_point(clamped_basis(true, 0.5), shape.control).y;
      EXPECT_GT(shape.lowest, middle);
      EXPECT_LT(shape.lowest, middle + 10);
    } else {
      EXPECT_GT(shape.lowest, 1e6);
    }
  }
}

TEST(FacingPairs, LipsFaceAndBrowsKeepTheirLength) {
  for (const FeatureId id : kFeatures) {
    const SnakeCurve curve = curve_of(id);
    const RestShape shape = shape_of(id);
    const auto pairs = facing_pairs(id, curve, shape.control);
    EXPECT_EQ(pairs.empty(), is_upper_lid(id)) << feature(id).name;
    for (const FacingPair& p : pairs) {
      const glm::dvec2 gap = curve_point(curve.points()[p.to], shape.control) -
                             curve_point(curve.points()[p.from], shape.control);
      const double along = gap.x * p.direction.x + gap.y * p.direction.y;
      EXPECT_GE(p.min_gap, 0);
      EXPECT_LE(p.min_gap, std::max(0.0, along)) << feature(id).name << ": at rest no force acts";
    }
  }
}

}  // namespace
}  // namespace fbs
