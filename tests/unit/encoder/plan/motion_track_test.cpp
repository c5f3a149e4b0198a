#include "encoder/plan/motion_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/encoder/plan/flat_group.h"

namespace fbs {
namespace {

constexpr int kPictures = 20;
constexpr std::uint32_t kNominal = 3000;

MotionTrack track_at(double lambda, double motion_kbps = 0) {
  Setup setup;
  setup.format.width = 176;
  setup.format.height = 144;
  setup.format.frame_rate = {30, 1};
  setup.steps = kFlatSteps;
  RatePlan rate{OperatingPoint::at(50, 32), motion_kbps};
  rate.point.lambda = lambda;
  return {setup, flat_anchor(), rate, SceneTiming(setup.format, {})};
}

/// A head that shakes, from a phase on.
std::vector<PictureCost> shaking(int phase) {
  auto pictures = flat_group(kPictures, 40);
  for (int t = 0; t < kPictures; ++t)
    for (std::size_t i = 0; i < kPoseCount; ++i)
      pictures[t].fit[i] += 12 * std::sin(0.7 * (phase + t)) * step_of(kFlatSteps, i);
  return pictures;
}

Result<MotionTrack::Group> next(MotionTrack& track, int phase) {
  return track.add(shaking(phase), std::vector<std::uint32_t>(kPictures, 0));
}

TEST(MotionTrack, FollowsTheFitsWhereBitsAreCheap) {
  MotionTrack track = track_at(0.1);
  for (const int phase : {0, kPictures}) {
    const auto group = next(track, phase);
    ASSERT_TRUE(group);
    ASSERT_EQ(group->states.size(), std::size_t{kPictures});
    const auto fits = shaking(phase);
    for (int t = 0; t < kPictures; ++t)
      for (std::size_t i = 0; i < kPoseCount; ++i)
        EXPECT_NEAR(group->states[t].pose[i], fits[t].fit[i], 2 * step_of(kFlatSteps, i)) << t;
  }
}

TEST(MotionTrack, ACopyContinuesFromWhereItWasMade) {
  MotionTrack track = track_at(10);
  ASSERT_TRUE(next(track, 0));
  MotionTrack copy = track;
  const auto second = next(track, 5), third = next(track, 9);
  ASSERT_TRUE(second && third);
  const auto again = next(copy, 5), then = next(copy, 9);
  ASSERT_TRUE(again && then);
  EXPECT_EQ(again->payload, second->payload);
  EXPECT_EQ(then->payload, third->payload);
  EXPECT_EQ(then->states, third->states);
}

TEST(MotionTrack, KeepsToARateOfTheMotion) {
  constexpr double kKbps = 0.3;
  MotionTrack free = track_at(1), held = track_at(1, kKbps);
  std::size_t free_bytes = 0, held_bytes = 0;
  for (int g = 0; g < 6; ++g) {
    free_bytes += next(free, g)->payload.size();
    held_bytes += next(held, g)->payload.size();
  }
  const double allowed = kKbps * 125 * 6 * kPictures * kNominal / 90000;
  EXPECT_GT(static_cast<double>(free_bytes), 1.2 * allowed);
  EXPECT_LT(static_cast<double>(held_bytes), 1.05 * allowed);
}

}  // namespace
}  // namespace fbs
