#include "tests/figures/edited_state.h"

#include <gtest/gtest.h>

#include "decoder/head/mouth_interior.h"

namespace fbs::figures {
namespace {

Geometry generic_geometry() {
  Geometry out;
  for (std::size_t v = 0; v < kVertexCount; ++v) out.positions[v] = generic_head().vertices[v].position;
  return out;
}

/// Between the middles of the inner lips, eye distances.
double gap(const State& state) {
  return static_cast<double>(mouth_gap(generic_geometry(), state)) / kUnitsPerEyeDistance;
}

TEST(EditedState, TheMouthOpensAsFarAsAskedFor) {
  EXPECT_NEAR(gap(with_mouth_open({}, 0.3)) - gap({}), 0.3, 0.005);
}

TEST(EditedState, BrowsRiseByAsMuchAsAskedForAndTheMouthHardlyMoves) {
  const State raised = with_brows_raised({}, 0.14);
  double up = 0;
  for (const FeatureId id : {FeatureId::kBrowRight, FeatureId::kBrowLeft})
    for (std::size_t c = 0; c < 4; ++c) up -= raised.control[feature(id).first_control + c].y / 8.0;
  EXPECT_NEAR(up / kUnitsPerEyeDistance, 0.14, 0.002);
  EXPECT_NEAR(gap(raised), gap({}), 0.01);
}

TEST(EditedState, TurnsAddUp) {
  EXPECT_EQ(turned(turned({}, 20, 0), -20, 10).pose, turned({}, 0, 10).pose);
  EXPECT_EQ(turned({}, 90, 0).pose[kYaw], 1 << 14);
}

}  // namespace
}  // namespace fbs::figures
