#include "bitstream/payload/motion_payload.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include "bitstream/entropy/range_coder.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/track.h"
#include "tests/unit/bitstream/random_tracks.h"

namespace fbs {
namespace {

Setup sample_setup(PartMask parts = kAllParts) {
  Setup setup;
  setup.format.width = 352;
  setup.format.height = 288;
  setup.format.frame_rate = {30, 1};
  setup.parts = parts;
  return setup;
}

constexpr auto kPoseOnly = mask_of(PartId::kPose);
constexpr auto kSome = static_cast<PartMask>(kPoseOnly | mask_of(PartId::kGround) | mask_of(PartId::kMouth) |
                                             mask_of(PartId::kGaze));

/// Of pattern 0: the eyes some 50 pixels apart.
CodedState sample_seen(const CodedLimits& limits) {
  CodedState seen{};
  seen[kLogScale] = std::min(2900, limits.most[kLogScale]);
  return seen;
}

/// A writer, and the groups that it is given.
struct Sender {
  explicit Sender(const Setup& setup, unsigned seed = 1)
      : seen(sample_seen(CodedLimits(setup.steps, setup.parts))), coder(setup, seen), random(seed) {}

  /// A group that follows what has been written.
  MotionGroup next(const TrackHabits& habits, std::int32_t pictures, bool key = false) {
    const bool begins = key || coder.needs_key();
    MotionGroup group = random_group(random, coder.limits(), coder.anchor(begins), pictures, habits);
    group.key = begins;
    return group;
  }

  CodedState seen;
  MotionCoder coder;
  std::mt19937 random;
};

TEST(MotionCoder, RoundTripsRandomTracks) {
  for (const TrackHabits habits : {TrackHabits{.knot_one_in = 8, .moves_one_in = 2, .reach = 1},
                                   TrackHabits{.knot_one_in = 3, .moves_one_in = 2, .reach = 3},
                                   TrackHabits{.knot_one_in = 1, .moves_one_in = 1, .reach = 30},
                                   TrackHabits{.knot_one_in = 30, .moves_one_in = 1, .reach = 1 << 20}}) {
    for (const PartMask parts : {kPoseOnly, kAllParts, kSome}) {
      const auto setup = sample_setup(parts);
      Sender sender(setup, 7);
      MotionCoder reader(setup, sender.seen);
      for (int g = 0; g < 12; ++g) {
        const MotionGroup group = sender.next(habits, g == 0 ? 1 : 16, g % 4 == 0);
        const auto payload = sender.coder.encode(group);
        ASSERT_TRUE(payload) << payload.error().text;
        const auto read = reader.decode(*payload);
        ASSERT_TRUE(read) << read.error().text;
        ASSERT_EQ(*read, group);
      }
    }
  }
}

TEST(MotionCoder, RoundTripsTheLargestGroupAndTheCoarsestSteps) {
  auto setup = sample_setup();
  setup.steps = {kMaxStep, kMaxStep, kMaxStep, kMaxStep, kMaxStep};
  Sender sender(setup);
  MotionCoder reader(setup, sender.seen);
  const MotionGroup group = sender.next({.knot_one_in = 2, .moves_one_in = 1, .reach = 3}, kMaxGroupPictures);
  EXPECT_EQ(*reader.decode(*sender.coder.encode(group)), group);
}

TEST(MotionCoder, EachPartMayHaveItsOwnKnots) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionCoder reader(setup, sender.seen);
  for (std::size_t busy = 0; busy < kPartCount; ++busy) {
    MotionGroup group = sender.next({.knot_one_in = 1000, .moves_one_in = 1, .reach = 2}, 20);
    Track& track = group.tracks[busy];
    track.insert(track.begin(), {{0, track.back().value}, {13, track.back().value}});
    track[1].value[0] += 1;
    EXPECT_EQ(*reader.decode(*sender.coder.encode(group)), group) << kPartNames[busy];
  }
}

TEST(MotionCoder, GroupThatHoldsCostsAlmostNothing) {
  Sender sender(sample_setup());
  ASSERT_TRUE(sender.coder.encode(sender.next({.knot_one_in = 4, .moves_one_in = 1, .reach = 3}, 30)));
  // A span to the end for each part, and that it does not move: two bits each, until they are learned.
  std::size_t size = 0;
  for (int g = 0; g < 6; ++g) {
    const CodedState held = sender.coder.anchor(false);
    MotionGroup group = knots_everywhere(held, {held}, kAllParts);
    group.pictures = 30;
    for (Track& track : group.tracks) track.front().picture = 29;
    size = sender.coder.encode(group)->size();
    EXPECT_LE(size, 6U) << g;
  }
  EXPECT_LE(size, 3U);
}

TEST(MotionCoder, KeyGroupDecodesWithoutTheGroupsBefore) {
  const auto setup = sample_setup();
  Sender sender(setup, 3);
  MotionCoder late(setup, sender.seen);
  for (int g = 0; g < 6; ++g) {
    const MotionGroup group = sender.next({}, 20, g % 3 == 0);
    const auto payload = *sender.coder.encode(group);
    if (g < 3) continue;
    EXPECT_EQ(*late.decode(payload), group);
  }
}

TEST(MotionCoder, KeyGroupBeginsWhereThePatternWasSeen) {
  const auto setup = sample_setup();
  Sender sender(setup);
  const TrackHabits wild{.knot_one_in = 1, .moves_one_in = 1, .reach = 50};
  const MotionGroup first = sender.next(wild, 5);
  EXPECT_EQ(first.anchor, sender.seen);
  ASSERT_TRUE(sender.coder.encode(first));
  EXPECT_EQ(sender.coder.anchor(false), last_of(first));
  EXPECT_EQ(sender.coder.anchor(true), sender.seen);
  const auto key = *sender.coder.encode(sender.next(wild, 5, true));
  EXPECT_EQ(MotionCoder(setup, sender.seen).decode(key)->anchor, sender.seen);
}

TEST(MotionCoder, GroupThatIsNotKeyNeedsTheOneBefore) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionCoder reader(setup, sender.seen);
  MotionGroup first = sender.next({}, 20);
  first.key = false;
  EXPECT_EQ(sender.coder.encode(first).error().code, ErrorCode::kInvalidArgument);
  first.key = true;
  const auto one = *sender.coder.encode(first);
  const auto two = *sender.coder.encode(sender.next({}, 20));
  const MotionGroup third = sender.next({}, 20, true);
  const auto three = *sender.coder.encode(third);
  EXPECT_EQ(reader.decode(two).error().code, ErrorCode::kInvalidStream);
  ASSERT_TRUE(reader.decode(one));
  reader.lose();
  EXPECT_TRUE(reader.needs_key());
  EXPECT_EQ(reader.decode(two).error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(*reader.decode(three), third) << "a key group ends the loss";
  EXPECT_FALSE(reader.needs_key());
}

TEST(MotionCoder, CarriesDurations) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionCoder reader(setup, sender.seen);
  std::mt19937 random(1);
  for (int g = 0; g < 5; ++g) {
    MotionGroup group = sender.next({}, 30);
    for (int i = 0; i < 30 && g != 3; ++i) group.durations.push_back(random() % 3 == 0 ? 3060 : 2970);
    if (g == 1) group.durations[3] = kMaxDuration;
    if (g == 2) group.durations[5] = 1;
    EXPECT_EQ(*reader.decode(*sender.coder.encode(group)), group);
  }
}

TEST(MotionCoder, ChecksEveryBoundAndStaysAsItWas) {
  const auto setup = sample_setup(kSome);
  Sender sender(setup);
  const MotionGroup good = sender.next({.knot_one_in = 1, .moves_one_in = 1, .reach = 2}, 5);
  ASSERT_EQ(good.tracks[0].size(), 5U);
  const auto pose = static_cast<std::size_t>(PartId::kPose), light = static_cast<std::size_t>(PartId::kLight),
             gaze = static_cast<std::size_t>(PartId::kGaze);
  const std::vector<std::function<void(MotionGroup&)>> breaks = {
      [](auto& g) { g.pictures = 0; },
      [](auto& g) { g.pictures = kMaxGroupPictures + 1; },
      [](auto& g) { g.pictures = 6; },  // the last picture has no knot
      [](auto& g) { g.pictures = 4; },  // a knot behind the end
      [](auto& g) { g.key = false; },
      [](auto& g) { ++g.anchor[kYaw]; },
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
    const auto payload = sender.coder.encode(group);
    ASSERT_FALSE(payload) << i;
    EXPECT_EQ(payload.error().code, ErrorCode::kInvalidArgument) << i;
  }
  EXPECT_TRUE(sender.coder.needs_key());
  for (const std::uint64_t cost : sender.coder.cost_of_parts()) EXPECT_EQ(cost, 0U);
  EXPECT_EQ(*sender.coder.encode(good), *MotionCoder(setup, sender.seen).encode(good));
}

TEST(MotionCoder, CostsOfPartsSumToThePayload) {
  const auto setup = sample_setup(kSome);
  Sender sender(setup);
  double written = 0;
  for (int g = 0; g < 4; ++g) {
    MotionGroup group = sender.next({.knot_one_in = 3, .moves_one_in = 1, .reach = 4}, 60);
    if (g == 3)
      for (std::uint32_t i = 0; i < 60; ++i) group.durations.push_back(2000 + i * 7 % 50);
    written += 8 * static_cast<double>(sender.coder.encode(group)->size());
  }
  const auto& costs = sender.coder.cost_of_parts();
  const double counted =
      static_cast<double>(std::accumulate(costs.begin(), costs.end(), std::uint64_t{0})) / 256;
  EXPECT_NEAR(counted, written, 0.01 * written + 4 * 16) << "header and end are not counted";
  for (std::size_t p = 0; p < kPartCount; ++p)
    EXPECT_EQ(costs[p] > 0, (kSome >> p & 1) != 0) << kPartNames[p];
  EXPECT_GT(costs[kPartCount], 100U * 256) << "durations";
}

TEST(MotionCoder, CopyGoesOnByItself) {
  Sender sender(sample_setup());
  const TrackHabits habits{.knot_one_in = 3, .moves_one_in = 1, .reach = 4};
  ASSERT_TRUE(sender.coder.encode(sender.next(habits, 20)));
  const MotionGroup tried = sender.next(habits, 20), taken = sender.next(habits, 20);
  MotionCoder trial = sender.coder, same = sender.coder;
  ASSERT_TRUE(trial.encode(tried));
  EXPECT_EQ(*sender.coder.encode(taken), *same.encode(taken)) << "a trial leaves no trace";
}

// A steady turn costs one knot a group where it would cost one a picture.
TEST(MotionCoder, StraightMotionIsCheaperAsOneSpan) {
  const auto setup = sample_setup(kPoseOnly);
  const CodedState seen = sample_seen(CodedLimits(setup.steps, setup.parts));
  MotionCoder straight(setup, seen), stepwise(setup, seen);
  std::vector<CodedState> states(30, seen);
  for (std::size_t t = 0; t < 30; ++t)
    for (std::size_t i = 0; i < kPoseCount; ++i)
      states[t][i] += (static_cast<int>(i) - 2) * (static_cast<int>(t) + 1);
  MotionGroup all = knots_everywhere(seen, states, setup.parts);
  all.key = true;
  MotionGroup one = all;
  one.tracks[0] = {all.tracks[0].back()};
  ASSERT_EQ(states_of(one, setup.steps), states_of(all, setup.steps));
  const auto bits = [](MotionCoder& coder, const MotionGroup& group) {
    EXPECT_TRUE(coder.encode(group));
    return static_cast<double>(coder.cost_of_parts()[0]) / 256;
  };
  EXPECT_LT(bits(straight, one), 0.75 * bits(stepwise, all));
}

TEST(MotionCoder, ReportsTruncationOrDamageButNeverCrashes) {
  const auto setup = sample_setup();
  Sender sender(setup, 3);
  const TrackHabits habits{.knot_one_in = 3, .moves_one_in = 1, .reach = 3};
  const auto key = *sender.coder.encode(sender.next(habits, 20));
  const auto next = *sender.coder.encode(sender.next(habits, 20));
  EXPECT_EQ(MotionCoder(setup, sender.seen).decode({}).error().code, ErrorCode::kInvalidStream)
      << "zeros: not a key group";
  // The decoder reads zeros past the end: they may break a limit before there are too many of them, or be a
  // group that holds. The check of the packet is what tells.
  int truncated = 0, held = 0;
  for (std::size_t size = 1; size + 20 < key.size(); ++size) {
    const auto read = MotionCoder(setup, sender.seen).decode(std::span(key).first(size));
    truncated += !read && read.error().code == ErrorCode::kTruncated ? 1 : 0;
    held += read ? 1 : 0;
  }
  EXPECT_GT(truncated, 0);
  EXPECT_LT(held, static_cast<int>(key.size()) / 4);
  auto longer = key;
  longer.insert(longer.end(), {1, 2, 3, 4, 5, 6, 7, 8});  // more than the decoder looks ahead
  EXPECT_EQ(MotionCoder(setup, sender.seen).decode(longer).error().code, ErrorCode::kInvalidStream);
  std::mt19937 random(10);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    auto bytes = i % 2 == 0 ? key : next;
    for (unsigned k = 1 + random() % 5; k > 0; --k)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (i % 3 == 0) bytes.resize(random() % bytes.size());
    MotionCoder reader(setup, sender.seen);
    if (i % 2 == 1) {
      ASSERT_TRUE(reader.decode(key));
    }
    const auto read = reader.decode(bytes);
    EXPECT_EQ(reader.needs_key(), !read.has_value());
    if (!read) {
      ++refused;
      continue;
    }
    EXPECT_TRUE(reader.limits().hold(last_of(*read)));
    if (read->key) {
      EXPECT_TRUE(MotionCoder(setup, sender.seen).encode(*read)) << "what was read can be written";
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(MotionCoder, SurvivesRandomPayloads) {
  std::mt19937 random(12);
  for (int i = 0; i < 5000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 200);
    for (auto& byte : bytes)
      byte = static_cast<std::uint8_t>(i % 2 == 0 ? random() : random() % 4 == 0 ? random() : 0);
    if (!bytes.empty()) bytes[0] = static_cast<std::uint8_t>(bytes[0] | 0xF0);  // a key group
    const auto setup = sample_setup(static_cast<PartMask>((random() & kAllParts) | kPoseOnly));
    MotionCoder reader(setup, sample_seen(CodedLimits(setup.steps, setup.parts)));
    if (const auto read = reader.decode(bytes)) {
      EXPECT_EQ(states_of(*read, setup.steps).size(), static_cast<std::size_t>(read->pictures));
      EXPECT_TRUE(reader.limits().hold(last_of(*read)));
    }
  }
}

/// A key group's code up to its count, which is not said: it is that of the group before.
TEST(MotionCoder, RefusesAGroupOfNoPictures) {
  RangeEncoder encoder;
  AdaptiveBit other_count;
  encoder.raw_bit(15 << 12, true);
  encoder.bit(other_count, false);
  EXPECT_EQ(MotionCoder(sample_setup(), {}).decode(encoder.finish()).error().code, ErrorCode::kInvalidStream);
}

// SPEC 4.5: key flag, count and durations flag are inside the range code.
TEST(MotionCoder, HeaderCostsLittleWhereItSaysNothingNew) {
  Sender sender(sample_setup(kPoseOnly));
  const auto held = [&](std::int32_t pictures) {
    const CodedState at = sender.coder.anchor(sender.coder.needs_key());
    MotionGroup group = knots_everywhere(at, {at}, kPoseOnly);
    group.key = sender.coder.needs_key();
    group.pictures = pictures;
    group.tracks[0].front().picture = pictures - 1;
    return group;
  };
  for (int g = 0; g < 20; ++g) ASSERT_TRUE(sender.coder.encode(held(30)));
  const auto cost = [&](const MotionGroup& group) {
    MotionCoder trial = sender.coder;
    EXPECT_TRUE(trial.encode(group));
    const auto sum = [](const PartCosts& c) { return std::accumulate(c.begin(), c.end(), 0.0) / 256; };
    return sum(trial.cost_of_parts()) - sum(sender.coder.cost_of_parts());
  };
  EXPECT_LT(cost(held(30)), 1) << "bits";
  EXPECT_GT(cost(held(31)), 8 + cost(held(30))) << "the count, and that it is another";
  MotionGroup timed = held(30);
  timed.durations.assign(30, 3000);
  EXPECT_GT(cost(timed), 2 + cost(held(30)));
  MotionCoder same = sender.coder, fresh = sender.coder;
  MotionGroup key = held(30);
  key.key = true;
  key.anchor = fresh.anchor(true);
  EXPECT_GT(fresh.encode(key)->size(), same.encode(held(30))->size());
}

}  // namespace
}  // namespace fbs
