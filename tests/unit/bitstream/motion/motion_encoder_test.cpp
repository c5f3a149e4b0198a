#include "bitstream/motion/motion_encoder.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "bitstream/motion/motion_bit_counter.h"
#include "bitstream/track.h"
#include "tests/unit/bitstream/motion/motion_sample.h"

namespace fbs {
namespace {

TEST(MotionEncoder, GroupAtRestCostsAlmostNothing) {
  Sender sender(sample_setup());
  ASSERT_TRUE(sender.encoder.encode(sender.next({.knot_one_in = 4, .moves_one_in = 1, .reach = 3}, 30)));
  // For each part a span to the end over which it does not move: two bits, until contexts have adapted.
  std::size_t size = 0;
  for (int g = 0; g < 6; ++g) {
    const CodedState held = sender.encoder.anchor();
    MotionGroup group = knots_everywhere(held, {held}, kAllParts);
    group.first = sender.encoder.next();
    group.pictures = 30;
    for (Track& track : group.tracks) track.front().picture = 29;
    size = sender.encoder.encode(group)->size();
    EXPECT_LE(size, 6U) << g;
  }
  EXPECT_LE(size, 3U);
}

TEST(MotionEncoder, GroupsBeginWhereTheOneBeforeEnds) {
  Sender sender(sample_setup());
  const TrackHabits wild{.knot_one_in = 1, .moves_one_in = 1, .reach = 50};
  const MotionGroup first = sender.next(wild, 5);
  EXPECT_EQ(first.anchor, sender.seen);
  EXPECT_EQ(first.first, 0);
  ASSERT_TRUE(sender.encoder.encode(first));
  EXPECT_EQ(sender.encoder.anchor(), last_of(first));
  EXPECT_EQ(sender.encoder.next(), 5);
  const MotionGroup key = sender.next(wild, 7, true);
  EXPECT_EQ(key.anchor, last_of(first)) << "a key group as well";
  ASSERT_TRUE(sender.encoder.encode(key));
  EXPECT_EQ(sender.encoder.next(), 12);
}

// SPEC 4.5: whatever came before, the first knots of a key group are the same bits.
TEST(MotionEncoder, KeyGroupIsCodedFromTheRestStateWhateverItsAnchor) {
  const auto setup = sample_setup();
  const TrackHabits habits{.knot_one_in = 3, .moves_one_in = 1, .reach = 40};
  std::vector<std::vector<std::uint8_t>> keys;
  for (const unsigned seed : {1U, 2U}) {
    Sender sender(setup, seed), same(setup, 3);
    ASSERT_TRUE(sender.encoder.encode(sender.next(habits, 5)));
    MotionGroup key = same.next(habits, 20, true);
    key.first = sender.encoder.next();
    key.anchor = sender.encoder.anchor();
    keys.push_back(*sender.encoder.encode(key));
  }
  EXPECT_EQ(keys[0], keys[1]);
}

TEST(MotionEncoder, ChecksEveryBoundAndStaysUnchanged) {
  const auto setup = sample_setup(kSomeParts);
  Sender sender(setup);
  const MotionGroup good = sender.next({.knot_one_in = 1, .moves_one_in = 1, .reach = 2}, 5);
  ASSERT_EQ(good.tracks[0].size(), 5U);
  const auto pose = index_of(PartId::kPose), light = index_of(PartId::kLight), gaze = index_of(PartId::kGaze);
  const std::vector<std::function<void(MotionGroup&)>> breaks = {
      [](auto& g) { g.pictures = 0; },
      [](auto& g) { g.pictures = kMaxGroupPictures + 1; },
      [](auto& g) { g.pictures = 6; },  // the last picture has no knot
      [](auto& g) { g.pictures = 4; },  // a knot after the end
      [](auto& g) { g.key = false; },
      [](auto& g) { ++g.anchor[kYaw]; },
      [](auto& g) { ++g.first; },
      [](auto& g) { --g.first; },
      [](auto& g) { g.missing = 1; },
      [](auto& g) {
        g.durations = {1, 2};
      },
      [](auto& g) {
        g.durations = {1, 2, 3, 4, 0};
      },
      [](auto& g) {
        g.durations = {1, 2, 3, 4, kMaxDuration + 1};
      },
      [&](auto& g) { g.tracks[pose].clear(); },
      [&](auto& g) { g.tracks[pose][1].picture = 0; },
      [&](auto& g) { g.tracks[pose][0].picture = -1; },
      [&](auto& g) { std::swap(g.tracks[pose][1].picture, g.tracks[pose][2].picture); },
      [&](auto& g) { g.tracks[pose][1].value[kPitch] = kMaxRotation; },
      [&](auto& g) { g.tracks[pose][1].value[kLogScale] = -1; },
      [&](auto& g) { g.tracks[gaze][2].value[4] = 1; },  // gaze has four numbers
      [&](auto& g) {
        g.tracks[light].push_back({4, {}});
      },  // is not sent
  };
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    MotionGroup group = good;
    breaks[i](group);
    const auto payload = sender.encoder.encode(group);
    ASSERT_FALSE(payload) << i;
    EXPECT_EQ(payload.error().code, ErrorCode::kInvalidArgument) << i;
  }
  EXPECT_EQ(sender.encoder.groups(), 0);
  EXPECT_EQ(*sender.encoder.encode(good), *MotionEncoder(setup, sender.seen).encode(good));
}

TEST(MotionEncoder, CopyContinuesIndependently) {
  Sender sender(sample_setup());
  const TrackHabits habits{.knot_one_in = 3, .moves_one_in = 1, .reach = 4};
  ASSERT_TRUE(sender.encoder.encode(sender.next(habits, 20)));
  const MotionGroup tried = sender.next(habits, 20), taken = sender.next(habits, 20);
  MotionEncoder trial = sender.encoder, same = sender.encoder;
  ASSERT_TRUE(trial.encode(tried));
  EXPECT_EQ(*sender.encoder.encode(taken), *same.encode(taken)) << "a trial leaves no trace";
}

// A steady rotation needs one knot a group instead of one a picture.
TEST(MotionEncoder, StraightMotionIsCheaperAsOneSpan) {
  const auto setup = sample_setup(kPoseOnly);
  const CodedState seen = sample_seen(setup);
  std::vector<CodedState> states(30, seen);
  for (std::size_t t = 0; t < 30; ++t)
    for (std::size_t i = 0; i < kPoseCount; ++i)
      states[t][i] += (static_cast<int>(i) - 2) * (static_cast<int>(t) + 1);
  MotionGroup all = knots_everywhere(seen, states, setup.parts);
  all.key = true;
  MotionGroup one = all;
  one.tracks[0] = {all.tracks[0].back()};
  ASSERT_EQ(states_of(one, setup.steps), states_of(all, setup.steps));
  const auto bits = [&](const MotionGroup& group) {
    return static_cast<double>(MotionBitCounter(setup, seen).count(group)[0]) / 256;
  };
  EXPECT_LT(bits(one), 0.75 * bits(all));
}

}  // namespace
}  // namespace fbs
