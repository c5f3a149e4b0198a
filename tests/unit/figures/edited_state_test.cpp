#include "tests/figures/edited_state.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fbs::figures {
namespace {

Geometry generic_geometry() {
  Geometry out;
  for (std::size_t v = 0; v < kVertexCount; ++v) out.positions[v] = generic_head().vertices[v].position;
  return out;
}

const Geometry& narrow_mouth() {
  static const Geometry geometry = [] {
    Geometry out = generic_geometry();
    for (glm::ivec3& p : out.positions) p.x /= 2;
    return out;
  }();
  return geometry;
}

State at_scale(std::int32_t log_scale) {
  State out;
  out.pose[kLogScale] = log_scale;
  return out;
}

TEST(EditedState, TheMouthOpensAsFarAsAskedFor) {
  const Geometry head = generic_geometry();
  const State rest;
  const Actor actor{head, rest};
  EXPECT_NEAR(mouth_gap(with_mouth_open(rest, 0.3), actor) - mouth_gap(rest, actor), 0.3, 0.005);
}

TEST(EditedState, BrowsRiseByAsMuchAsAskedForAndTheMouthHardlyMoves) {
  const Geometry head = generic_geometry();
  const State rest, raised = with_brows_raised(rest, 0.14);
  double up = 0;
  for (const FeatureId id : {FeatureId::kBrowRight, FeatureId::kBrowLeft})
    for (std::size_t c = 0; c < 4; ++c) up -= raised.control[feature(id).first_control + c].y / 8.0;
  EXPECT_NEAR(up / kUnitsPerEyeDistance, 0.14, 0.002);
  EXPECT_NEAR(mouth_gap(raised, {head, rest}), mouth_gap(rest, {head, rest}), 0.01);
}

TEST(EditedState, TurnsAddUp) {
  EXPECT_EQ(turned(turned({}, 20, 0), -20, 10).pose, turned({}, 0, 10).pose);
  EXPECT_EQ(turned({}, 90, 0).pose[kYaw], 1 << 14);
}

TEST(EditedState, AFaceAtRestMakesTheOtherRest) {
  const Geometry head = generic_geometry();
  const State rest = at_scale(24 << 10), other = turned(at_scale(26 << 10), 5, 3);
  EXPECT_EQ(transferred(rest, {head, rest}, {narrow_mouth(), other}), other);
}

TEST(EditedState, MotionIsInProportionToTheFace) {
  const Geometry head = generic_geometry();
  const State rest = at_scale(20 << 10), other = at_scale(24 << 10);
  State moved = turned(rest, 10, 0);
  moved.pose[kShiftX] += 100;
  moved.control[0] = {400, -200};
  const State out = transferred(moved, {head, rest}, {narrow_mouth(), other});
  EXPECT_EQ(out.pose[kYaw], moved.pose[kYaw]);
  EXPECT_EQ(out.pose[kShiftX], 200) << "one octave larger";
  EXPECT_EQ(out.control[0], glm::ivec2(200, -100)) << "half as wide a mouth";
}

}  // namespace
}  // namespace fbs::figures
