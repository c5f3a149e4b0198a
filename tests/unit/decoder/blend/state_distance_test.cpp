#include "decoder/blend/state_distance.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr std::array<Region, kRegionCount> kRegions = {Region::kMouth, Region::kRightEye, Region::kLeftEye,
                                                       Region::kFace,  Region::kHair,     Region::kBody,
                                                       Region::kGround};

/// Regions for which a state is farther than toy_state().
std::vector<Region> regions_that_see(const State& state) {
  std::vector<Region> out;
  for (const Region region : kRegions)
    if (state_distance(region, state, toy_state(), 1) != 0) out.push_back(region);
  return out;
}

State moved(FeatureId id) {
  State state = toy_state();
  state.control[feature(id).first_control].y = 400;
  return state;
}

TEST(StateDistance, IsZeroForTheSameState) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const State state = random_state(random);
    for (const Region region : kRegions) EXPECT_EQ(state_distance(region, state, state, 1), 0);
  }
}

TEST(StateDistance, LooksAtWhatTheRegionShows) {
  EXPECT_EQ(regions_that_see(moved(FeatureId::kMouthInner)), (std::vector{Region::kMouth, Region::kFace}));
  EXPECT_EQ(regions_that_see(moved(FeatureId::kUpperLidRight)), (std::vector{Region::kRightEye}));
  EXPECT_EQ(regions_that_see(moved(FeatureId::kPupilLeft)), (std::vector{Region::kLeftEye}));
}

TEST(StateDistance, RotationCountsForTheHeadAndWhatItHangsOn) {
  for (const int axis : {kPitch, kYaw, kRoll}) {
    State state = toy_state();
    state.pose[axis] = 2000;
    for (const Region region : kRegions)
      EXPECT_EQ(state_distance(region, state, toy_state(), 1) > 0, region != Region::kGround) << axis;
  }
}

TEST(StateDistance, BodyCountsForTheBodyAlone) {
  State state = toy_state();
  state.body[kDisplacementX] = 640;
  EXPECT_EQ(regions_that_see(state), (std::vector{Region::kBody}));
}

// They change where the head is, not how it looks.
TEST(StateDistance, ShiftScaleAndLightDoNotCount) {
  State state = toy_state(100, 70);
  state.pose[kLogScale] += 1000;
  state.light = {100, 100, 100};
  state.interior = {50, 50, 50};
  EXPECT_TRUE(regions_that_see(state).empty());
}

TEST(StateDistance, TimeCountsByTheSpacingOfPatterns) {
  State later = toy_state();
  later.picture = 60;
  for (const Region region : kRegions) {
    const std::int64_t at_ten = state_distance(region, later, toy_state(), 10),
                       at_twenty = state_distance(region, later, toy_state(), 20);
    EXPECT_GT(at_twenty, 0);
    EXPECT_NEAR(static_cast<double>(at_ten), 4.0 * static_cast<double>(at_twenty), 8) << "squared";
  }
}

TEST(StateDistance, GrowsWithTheDifference) {
  for (int yaw = 0; yaw < 8000; yaw += 50) {
    State near_one = toy_state(), far_one = toy_state();
    near_one.pose[kYaw] = yaw;
    far_one.pose[kYaw] = yaw + 50;
    for (const Region region : {Region::kMouth, Region::kFace, Region::kHair})
      ASSERT_LT(state_distance(region, near_one, toy_state(), 1),
                state_distance(region, far_one, toy_state(), 1));
  }
}

// Sums of squares of the largest numbers do not overflow (sanitizers).
TEST(StateDistance, HoldsForEveryStateOfAStream) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    State a = random_state(random), b = random_state(random);
    a.picture = static_cast<std::int32_t>(random() >> 1);
    b.picture = static_cast<std::int32_t>(random() >> 1);
    for (const Region region : kRegions) ASSERT_GE(state_distance(region, a, b, 1), 0) << i;
  }
}

}  // namespace
}  // namespace fbs
