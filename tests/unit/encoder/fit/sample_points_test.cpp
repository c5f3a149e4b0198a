#include "encoder/fit/sample_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "encoder/fit/fit_tuning.h"
#include "tests/unit/encoder/fit/seen_scene.h"

namespace fbs {
namespace {

struct RestPoints {
  FitColumns columns{kAllParts};
  PlacedHead head{toy_geometry(), fit_of(SeenScene::rest())};
  SamplePoints points{toy_geometry(), columns, head, kFitPointSpacing};
};

TEST(SamplePoints, PatchesHoldEachPointOnceTriangleByTriangle) {
  const RestPoints r;
  std::size_t next = 0;
  for (const SamplePoints::Patch& patch : r.points.patches()) {
    EXPECT_EQ(patch.first, next);
    next = patch.end;
    EXPECT_EQ(patch.shares.size(), patch.size() * patch.controls.size());
    for (std::size_t k = patch.first; k < patch.end; ++k)
      EXPECT_EQ(r.points[k].triangle, r.points[patch.first].triangle);
  }
  EXPECT_EQ(next, r.points.size());
  EXPECT_EQ(r.points.patches().size(), generic_head().triangles.size());
}

TEST(SamplePoints, SharesSayHowFarAControlPointMovesAPoint) {
  const RestPoints r;
  constexpr double kFar = 1000;  // head units
  for (const SamplePoints::Patch& patch : r.points.patches())
    for (std::size_t i = 0; i < patch.controls.size(); ++i) {
      Offsets offsets{};
      offsets[static_cast<std::size_t>(patch.controls[i])].x = kFar;
      const HeadVertices moved = skinned(toy_geometry(), offsets);
      const double by = r.points[patch.first].on(moved).x - r.points[patch.first].on(r.head.vertices).x;
      EXPECT_NEAR(by, kFar * static_cast<double>(patch.shares[i]), 0.01);
    }
}

TEST(SamplePoints, StandForTheSamplesOfTheHead) {
  const RestPoints r;
  double samples = 0, area = 0;
  for (std::size_t n = 0; n < r.points.patches().size(); ++n)
    samples += r.points.samples_per_point(n, r.head) * static_cast<double>(r.points.patches()[n].size());
  for (const HeadTriangle& t : generic_head().triangles) area += r.head.visible_area(t);
  EXPECT_NEAR(samples, area, 1e-6 * area);
  EXPECT_GT(area, 48 * 48) << "square pixels";
}

// On the adapted head, whatever the expression of the seen state.
TEST(SamplePoints, LightIsThatOfTheDecoder) {
  StateMaker maker(4);
  State seen = SeenScene::rest();
  maker.mouth(seen);
  const SeenScene scene(seen, Plane(SeenScene::kWidth, SeenScene::kHeight));
  constexpr std::int32_t kLevels = 1000;
  for (std::size_t i = 0; i < kLightCount; ++i) {
    if (i == kLightGain) continue;
    State lit = SeenScene::rest();
    lit.light[i] = kLevels;
    const ScreenMesh mesh = scene.scene.geometry->screen_mesh(lit);
    for (std::size_t k = 0; k < scene.comparison.points.size(); ++k) {
      const SurfacePoint& p = scene.comparison.points[k];
      double offset = 0;
      for (std::size_t c = 0; c < 3; ++c)
        offset += static_cast<double>(p.barycentric[c]) * mesh.light[p.corner[c]].offset;
      EXPECT_NEAR(scene.comparison.points.light(k)[i], offset / kLevels, 1.0 / kLevels) << k << ' ' << i;
    }
  }
}

TEST(SamplePoints, RampsRiseFromUpperToLowerLipInTheMouthAlone) {
  const RestPoints r;
  int mouth = 0;
  for (std::size_t k = 0; k < r.points.size(); ++k) {
    const auto& c = r.points[k].corner;
    const bool inside = is_mouth(generic_head(), c);
    EXPECT_EQ(r.points.mouth_ramp(k) >= 0, inside) << k;
    EXPECT_LE(r.points.mouth_ramp(k), 1) << k;
    mouth += inside ? 1 : 0;
  }
  EXPECT_GT(mouth, 6 * kMinMouthRows);
}

}  // namespace
}  // namespace fbs
