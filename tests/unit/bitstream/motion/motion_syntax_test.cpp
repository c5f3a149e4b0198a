#include "bitstream/motion/motion_syntax.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "bitstream/motion/motion_bit_counter.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/track.h"
#include "tests/unit/bitstream/motion/motion_sample.h"

namespace fbs {
namespace {

TEST(MotionSyntax, RoundTripsRandomTracks) {
  for (const TrackHabits habits : {TrackHabits{.knot_one_in = 8, .moves_one_in = 2, .reach = 1},
                                   TrackHabits{.knot_one_in = 3, .moves_one_in = 2, .reach = 3},
                                   TrackHabits{.knot_one_in = 1, .moves_one_in = 1, .reach = 30},
                                   TrackHabits{.knot_one_in = 30, .moves_one_in = 1, .reach = 1 << 20}}) {
    for (const PartMask parts : {kPoseOnly, kAllParts, kSomeParts}) {
      const auto setup = sample_setup(parts);
      Sender sender(setup, 7);
      MotionDecoder reader(setup, sender.seen);
      for (int g = 0; g < 12; ++g) {
        const MotionGroup group = sender.next(habits, g == 0 ? 1 : 16, g % 4 == 0);
        const auto payload = sender.encoder.encode(group);
        ASSERT_TRUE(payload) << payload.error().text;
        const auto read = reader.decode(*payload);
        ASSERT_TRUE(read) << read.error().text;
        ASSERT_EQ(**read, group);
      }
    }
  }
}

TEST(MotionSyntax, RoundTripsTheLargestGroupAndTheCoarsestSteps) {
  auto setup = sample_setup();
  setup.steps = {kMaxStep, kMaxStep, kMaxStep, kMaxStep, kMaxStep};
  Sender sender(setup);
  MotionDecoder reader(setup, sender.seen);
  const MotionGroup group = sender.next({.knot_one_in = 2, .moves_one_in = 1, .reach = 3}, kMaxGroupPictures);
  EXPECT_EQ(**reader.decode(*sender.encoder.encode(group)), group);
}

TEST(MotionSyntax, EachPartMayHaveItsOwnKnots) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionDecoder reader(setup, sender.seen);
  for (std::size_t busy = 0; busy < kPartCount; ++busy) {
    MotionGroup group = sender.next({.knot_one_in = 1000, .moves_one_in = 1, .reach = 2}, 20);
    Track& track = group.tracks[busy];
    track.insert(track.begin(), {{0, track.back().value}, {13, track.back().value}});
    track[1].value[0] += 1;
    EXPECT_EQ(**reader.decode(*sender.encoder.encode(group)), group) << kPartNames[busy];
  }
}

TEST(MotionSyntax, CarriesDurations) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionDecoder reader(setup, sender.seen);
  std::mt19937 random(1);
  for (int g = 0; g < 5; ++g) {
    MotionGroup group = sender.next({}, 30);
    for (int i = 0; i < 30 && g != 3; ++i) group.durations.push_back(random() % 3 == 0 ? 3060 : 2970);
    if (g == 1) group.durations[3] = kMaxDuration;
    if (g == 2) group.durations[5] = 1;
    group.key = group.key || g == 4;
    EXPECT_EQ(**reader.decode(*sender.encoder.encode(group)), group);
  }
}

// SPEC 4.5: key flag, number of pictures and durations flag are inside the range code.
TEST(MotionSyntax, HeaderCostsLittleWhereItSaysNothingNew) {
  Sender sender(sample_setup(kPoseOnly));
  const auto held = [&](std::int32_t pictures) {
    const CodedState at = sender.encoder.anchor();
    MotionGroup group = knots_everywhere(at, {at}, kPoseOnly);
    group.key = sender.encoder.groups() == 0;
    group.first = sender.encoder.next();
    group.pictures = pictures;
    group.tracks[0].front().picture = pictures - 1;
    return group;
  };
  MotionBitCounter counter(sample_setup(kPoseOnly), sender.seen);
  for (int g = 0; g < 20; ++g) {
    const MotionGroup group = held(30);
    ASSERT_TRUE(sender.encoder.encode(group));
    (void)counter.count(group);
  }
  const auto cost = [&](const MotionGroup& group) {
    const PartBitsX256 bits = MotionBitCounter(counter).count(group);
    return std::accumulate(bits.begin(), bits.end(), 0.0) / 256;
  };
  EXPECT_LT(cost(held(30)), 1) << "bits";
  EXPECT_GT(cost(held(31)), 8 + cost(held(30))) << "another number of pictures";
  MotionGroup timed = held(30);
  timed.durations.assign(30, 3000);
  EXPECT_GT(cost(timed), 2 + cost(held(30)));
  MotionEncoder same = sender.encoder, fresh = sender.encoder;
  MotionGroup key = held(30);
  key.key = true;
  EXPECT_GT(fresh.encode(key)->size(), same.encode(held(30))->size());
}

TEST(MotionReference, ResetsToWhatItKnowsBeforeAScene) {
  const auto setup = sample_setup();
  MotionReference reference(setup, sample_seen(setup));
  EXPECT_EQ(reference.memory.duration_history.last, 3000u);
  reference.memory.pictures = 7;
  reference.memory.duration_history = {1, 2};
  reference.memory.tracks.to_end[0][0].update(true);
  reference.memory.track_history.change[3] = 5;
  reference.order.next = 20;
  reference.time = 60000;
  reference.reset();
  EXPECT_EQ(reference.order.next, 20) << "its place in the scene stays";
  EXPECT_EQ(reference.time, 60000U);
  EXPECT_EQ(reference.memory.pictures, 6) << "as a live stream has as a rule";
  EXPECT_EQ(reference.memory.duration_history.second_last, 3000u);
  EXPECT_EQ(reference.memory.tracks.to_end[0][0].zero(), std::uint32_t{trained_motion()[2].zero} << 8)
      << "behind other_count and has_durations";
  EXPECT_EQ(reference.memory.track_history.change[3], 0);
}

}  // namespace
}  // namespace fbs
