#include "encoder/retarget/fitted_tracks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bitstream/track.h"

namespace fbs {
namespace {

constexpr std::size_t kNumber = kShiftX;

/// Pictures in which one number of the pose follows `value`, and the others are zero.
template <class Value>
std::vector<StateNumbers> pictures(int count, Value&& value) {
  std::vector<StateNumbers> out(static_cast<std::size_t>(count));
  for (int t = 0; t < count; ++t) out[static_cast<std::size_t>(t)][kNumber] = value(t);
  return out;
}

std::vector<int> knots(const MotionGroup& group) {
  std::vector<int> out;
  for (const Knot& knot : group.tracks[index_of(PartId::kPose)]) out.push_back(knot.picture);
  return out;
}

Setup setup() {
  Setup out;
  out.steps.translation = 16;
  return out;
}

TEST(FittedTracks, StraightMotionHasOneKnot) {
  const auto group = fitted_tracks(pictures(20, [](int t) { return 16.0 * (t + 1); }), {}, setup());
  EXPECT_EQ(knots(group), std::vector{19});
  EXPECT_EQ(states_of(group, setup().steps)[9].pose[kShiftX], 160);
}

TEST(FittedTracks, BentMotionHasAKnotInTheBend) {
  const auto bent = pictures(20, [](int t) { return t < 8 ? 0.0 : 64.0 * (t - 7); });
  EXPECT_EQ(knots(fitted_tracks(bent, {}, setup())), (std::vector{7, 19}));
}

TEST(FittedTracks, RoundingMakesNoKnots) {
  const auto noisy = pictures(60, [](int t) { return 8.0 * std::sin(t * 1.7); });
  EXPECT_EQ(knots(fitted_tracks(noisy, {}, setup())), std::vector{59});
}

TEST(FittedTracks, StayNearEveryPicture) {
  const auto wild = pictures(100, [](int t) { return 900.0 * std::sin(0.02 * t * t); });
  const auto states = states_of(fitted_tracks(wild, {}, setup()), setup().steps);
  for (std::size_t t = 0; t < wild.size(); ++t)
    EXPECT_NEAR(states[t].pose[kShiftX], wild[t][kNumber], 0.75 * 16 + 1) << t;
}

TEST(FittedTracks, ReachThePicturesAlthoughTheAnchorIsElsewhere) {
  CodedState anchor{};
  anchor[kNumber] = 50;
  const auto still = pictures(10, [](int) { return 0.0; });
  EXPECT_EQ(knots(fitted_tracks(still, anchor, setup())), (std::vector{0, 9}));
}

TEST(FittedTracks, PartsThatAreNotSentHaveNone) {
  auto head_alone = setup();
  head_alone.parts = mask_of(PartId::kPose);
  const auto group = fitted_tracks(pictures(5, [](int t) { return 99.0 * t; }), {}, head_alone);
  for (std::size_t part = 1; part < kPartCount; ++part) EXPECT_TRUE(group.tracks[part].empty()) << part;
}

}  // namespace
}  // namespace fbs
