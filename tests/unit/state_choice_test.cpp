#include "encoder/state_choice.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/fitted_scene.h"

namespace fbs {
namespace {

struct StateChoice : ::testing::Test {
  FittedScene s;
  MotionCoder coder{s.setup};
  MotionCounter counter{coder, true};
  State before = s.seen;

  StateChoice() { counter.push(before); }

  [[nodiscard]] State choose(const State& truth, std::initializer_list<State> candidates, double lambda) {
    s.look_at(truth);
    return choose_state(std::vector<State>(candidates), s.fit, counter, lambda);
  }
};

TEST_F(StateChoice, TakesWhatMakesThePictureBetter) {
  State moved = before;
  moved.pose[kShiftX] += 200;
  moved.control[20] = {0, -400};
  EXPECT_EQ(choose(moved, {before, moved}, 1), moved);
}

TEST_F(StateChoice, KeepsWhatTheTrackerGotWrong) {
  State wrong = before;
  wrong.pose[kShiftX] += 300;
  EXPECT_EQ(choose(before, {before, wrong}, 1), before);
}

TEST_F(StateChoice, TakesEachPartForItself) {
  State truth = before, tracked;
  truth.pose[kShiftX] += 200;
  tracked = truth;
  tracked.control[20] = {600, 600};  // a brow that has run away
  EXPECT_EQ(choose(truth, {before, tracked}, 1), truth);
}

TEST_F(StateChoice, TakesEachPartFromTheCandidateThatHasItRight) {
  State truth = before, one, other;
  truth.pose[kShiftX] += 200;
  truth.control[20] = {0, -500};
  one = other = truth;
  one.control[20] = {0, 500};
  other.pose[kShiftX] -= 500;
  EXPECT_EQ(choose(truth, {before, one, other}, 1), truth);
}

TEST_F(StateChoice, PaysNoBitsForWhatNobodySees) {
  State tracked = before;
  tracked.pose[kShiftX] += 1;  // 1/64 pixel
  EXPECT_EQ(choose(tracked, {before, tracked}, 1e9), before);
}

}  // namespace
}  // namespace fbs
