#include "encoder/model/fit.h"

#include <gtest/gtest.h>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

State some_state() {
  State state = toy_state(160, 96);
  state.pose[kYaw] = 547;
  state.light = {-100, 7, 80, 16};
  state.interior = {33, -50, 4};
  for (std::size_t c = 0; c < kControlCount; ++c)
    state.control[c] = {3 * static_cast<int>(c), 7 - 11 * static_cast<int>(c)};
  return state;
}

TEST(Fit, OfAStateHasThatState) {
  EXPECT_EQ(state_of(fit_of(some_state())), some_state());
}

TEST(Fit, StateIsTheNearest) {
  Fit fit = fit_of(some_state());
  fit.light[0] += 0.4 / kLightUnitsPerLevel;
  fit.offsets[3] += 0.4;
  EXPECT_EQ(state_of(fit), some_state());
  fit.offsets[3].x += 0.2;
  EXPECT_EQ(state_of(fit).control[3].x, some_state().control[3].x + 1);
}

// Differences of light are taken between fits: nothing must remain of none.
TEST(Fit, OfAStateAtRestIsExactlyAtRest) {
  const Fit fit = fit_of(toy_state());
  for (const double light : fit.light) EXPECT_EQ(light, 0);
  for (const glm::dvec2& o : fit.offsets) EXPECT_EQ(o, glm::dvec2(0));
}

}  // namespace
}  // namespace fbs
