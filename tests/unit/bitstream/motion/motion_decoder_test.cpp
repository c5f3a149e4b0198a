#include "bitstream/motion/motion_decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "bitstream/entropy/range_coder.h"
#include "bitstream/track.h"
#include "tests/unit/bitstream/motion/motion_sample.h"

namespace fbs {
namespace {

/// Groups of 20 pictures, of which every third is key, and their packets.
struct Groups {
  explicit Groups(const Setup& setup, int count = 7, unsigned seed = 3) : sender(setup, seed) {
    for (int g = 0; g < count; ++g) {
      groups.push_back(sender.next({.knot_one_in = 4, .moves_one_in = 1, .reach = 20}, 20, g % 3 == 0));
      payloads.push_back(*sender.encoder.encode(groups.back()));
    }
  }
  Sender sender;
  std::vector<MotionGroup> groups;
  std::vector<std::vector<std::uint8_t>> payloads;
};

/// What a decoder makes of a group behind `missing` pictures without durations.
MotionGroup behind_gap(MotionGroup group, std::int32_t missing, const CodedState& known) {
  group.missing = missing;
  group.missing_time = static_cast<std::uint32_t>(missing) * 3000;
  group.anchor = known;
  return group;
}

TEST(MotionDecoder, KeyGroupDecodesWithoutTheGroupsBefore) {
  const auto setup = sample_setup();
  const Groups s(setup);
  MotionDecoder late(setup, s.sender.seen);
  EXPECT_EQ(**late.decode(s.payloads[3]), behind_gap(s.groups[3], 60, s.sender.seen));
  for (std::size_t g = 4; g < 7; ++g) EXPECT_EQ(**late.decode(s.payloads[g]), s.groups[g]) << g;
}

TEST(MotionDecoder, ALostGroupCostsThoseUpToTheNextKeyGroup) {
  const auto setup = sample_setup();
  const Groups s(setup);
  for (const std::size_t lost : {1U, 2U}) {
    MotionDecoder reader(setup, s.sender.seen);
    for (std::size_t g = 0; g < lost; ++g) ASSERT_EQ(**reader.decode(s.payloads[g]), s.groups[g]);
    for (std::size_t g = lost + 1; g < 3; ++g) {
      EXPECT_EQ(*reader.decode(s.payloads[g]), std::nullopt);
      EXPECT_TRUE(reader.needs_key());
    }
    const auto missing = static_cast<std::int32_t>(20 * (3 - lost));
    const auto key = **reader.decode(s.payloads[3]);
    EXPECT_EQ(key, behind_gap(s.groups[3], missing, last_of(s.groups[lost - 1])));
    EXPECT_EQ(last_of(key), last_of(s.groups[3])) << "as without loss";
    EXPECT_FALSE(reader.needs_key());
    for (std::size_t g = 4; g < 7; ++g) EXPECT_EQ(**reader.decode(s.payloads[g]), s.groups[g]) << g;
  }
}

TEST(MotionDecoder, WhatComesTwiceOrLateIsSkippedAndDoesNoHarm) {
  const auto setup = sample_setup();
  const Groups s(setup);
  MotionDecoder reader(setup, s.sender.seen);
  std::size_t read = 0;
  for (const std::size_t g : {0U, 0U, 1U, 0U, 1U, 3U, 2U, 3U, 4U, 2U, 5U}) {
    const auto group = reader.decode(s.payloads[g]);
    ASSERT_TRUE(group) << group.error().text;
    EXPECT_FALSE(reader.needs_key());
    if (!*group) continue;
    EXPECT_EQ((*group)->tracks, s.groups[g].tracks);
    ++read;
  }
  EXPECT_EQ(read, 5U) << "0, 1, 3, 4, 5";
}

TEST(MotionDecoder, AfterAnErrorOnlyAKeyGroupIsRead) {
  const auto setup = sample_setup();
  const Groups s(setup);
  MotionDecoder reader(setup, s.sender.seen);
  ASSERT_TRUE(reader.decode(s.payloads[0]));
  auto longer = s.payloads[1];
  longer.insert(longer.end(), 8, 0x55);
  EXPECT_EQ(reader.decode(longer).error().code, ErrorCode::kInvalidStream);
  EXPECT_TRUE(reader.needs_key());
  EXPECT_EQ(*reader.decode(s.payloads[1]), std::nullopt);
  EXPECT_EQ(*reader.decode(s.payloads[2]), std::nullopt);
  EXPECT_EQ(**reader.decode(s.payloads[3]), behind_gap(s.groups[3], 40, last_of(s.groups[0])));
}

TEST(MotionDecoder, ASceneBeginsWithAKeyGroup) {
  const auto setup = sample_setup();
  Groups s(setup);
  MotionGroup first = s.groups[0];
  first.key = false;
  EXPECT_EQ(MotionEncoder(setup, s.sender.seen).encode(first).error().code, ErrorCode::kInvalidArgument);
  RangeEncoder encoder;
  encoder.raw_bit(kNotKey, false);
  code_first(encoder, 0, 0);
  const auto not_key = encoder.finish();
  EXPECT_EQ(MotionDecoder(setup, s.sender.seen).decode(not_key).error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(*MotionDecoder(setup, s.sender.seen).decode(s.payloads[1]), std::nullopt)
      << "the key group is lost";
}

// SPEC 4.5: a key group says when it begins if it has durations.
TEST(MotionDecoder, MissingPicturesTakeTheTimeThatTheyHad) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionDecoder reader(setup, sender.seen);
  std::vector<std::vector<std::uint8_t>> payloads;
  for (int g = 0; g < 6; ++g) {
    MotionGroup group = sender.next({}, 10, g % 2 == 0);
    if (g != 3) group.durations.assign(10, static_cast<std::uint32_t>(2000 + 100 * g));
    payloads.push_back(*sender.encoder.encode(group));
  }
  ASSERT_TRUE(reader.decode(payloads[0]));
  const auto second = **reader.decode(payloads[2]);  // without 1
  EXPECT_EQ(second.missing, 10);
  EXPECT_EQ(second.missing_time, 21000U);
  const auto third = **reader.decode(payloads[4]);  // without 3, which has the nominal duration
  EXPECT_EQ(third.missing_time, 30000U);
  EXPECT_EQ(durations_of(third, setup.format.frame_rate), [] {
    std::vector<std::uint32_t> all(10, 3000);
    all.insert(all.end(), 10, 2400);
    return all;
  }());
  EXPECT_EQ((**reader.decode(payloads[5])).missing_time, 0U);
}

// Twenty bits are 11.65 s: the time that is nearest to the nominal one would be right.
TEST(MotionDecoder, MissingPicturesMayTakeLongerThanTheBitsOfTime) {
  const auto setup = sample_setup(kPoseOnly);
  Sender sender(setup);
  for (int g = 0; g < 2; ++g) ASSERT_TRUE(sender.encoder.encode(sender.next({}, 200)));
  MotionGroup key = sender.next({}, 1, true);
  key.durations = {3001};
  const auto read = MotionDecoder(setup, sender.seen).decode(*sender.encoder.encode(key));
  EXPECT_EQ((**read).missing, 400);
  EXPECT_EQ((**read).missing_time, 400U * 3000);
}

TEST(MotionDecoder, RefusesATimeThatIsTooShortForTheMissingPictures) {
  const auto setup = sample_setup(kPoseOnly);
  for (const std::uint32_t beyond : {19U, 20U}) {  // twenty pictures
    Sender sender(setup);
    MotionGroup lost = sender.next({}, 20), key;
    lost.durations.assign(20, 1);
    lost.durations.back() = (1U << kTimeBits) + beyond - 19;
    ASSERT_TRUE(sender.encoder.encode(lost));
    key = sender.next({}, 1, true);
    key.durations = {3000};
    const auto read = MotionDecoder(setup, sender.seen).decode(*sender.encoder.encode(key));
    EXPECT_EQ(read.has_value(), beyond == 20);
  }
}

TEST(MotionDecoder, ReportsTruncationOrDamageButNeverCrashes) {
  const auto setup = sample_setup();
  Sender sender(setup, 3);
  const TrackHabits habits{.knot_one_in = 3, .moves_one_in = 1, .reach = 3};
  const auto key = *sender.encoder.encode(sender.next(habits, 20));
  const auto next = *sender.encoder.encode(sender.next(habits, 20));
  EXPECT_EQ(MotionDecoder(setup, sender.seen).decode({}).error().code, ErrorCode::kInvalidStream)
      << "zeros: not a key group";
  // The decoder reads zeros past the end: these can break a limit before there are too many of them, or be a
  // group at rest. Truncation is detected by the check of the packet.
  int truncated = 0, at_rest = 0;
  for (std::size_t size = 1; size + 20 < key.size(); ++size) {
    const auto read = MotionDecoder(setup, sender.seen).decode(std::span(key).first(size));
    truncated += !read && read.error().code == ErrorCode::kTruncated ? 1 : 0;
    at_rest += read && *read ? 1 : 0;
  }
  EXPECT_GT(truncated, 0);
  EXPECT_LT(at_rest, static_cast<int>(key.size()) / 3);
  auto longer = key;
  longer.insert(longer.end(), {1, 2, 3, 4, 5, 6, 7, 8});  // more than the decoder looks ahead
  EXPECT_EQ(MotionDecoder(setup, sender.seen).decode(longer).error().code, ErrorCode::kInvalidStream);
  std::mt19937 random(10);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    auto bytes = i % 2 == 0 ? key : next;
    for (unsigned k = 1 + random() % 5; k > 0; --k)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (i % 3 == 0) bytes.resize(random() % bytes.size());
    MotionDecoder reader(setup, sender.seen);
    if (i % 2 == 1) {
      ASSERT_TRUE(reader.decode(key));
    }
    const auto read = reader.decode(bytes);
    refused += read ? 0 : 1;
    if (!read || !*read) continue;
    const MotionGroup& group = **read;
    EXPECT_FALSE(reader.needs_key());
    EXPECT_TRUE(sender.encoder.limits().hold(last_of(group)));
    if (group.first == 0) {
      EXPECT_TRUE(MotionEncoder(setup, sender.seen).encode(group)) << "what was read can be written";
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(MotionDecoder, SurvivesRandomPayloads) {
  std::mt19937 random(12);
  for (int i = 0; i < 5000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 200);
    for (auto& byte : bytes)
      byte = static_cast<std::uint8_t>(i % 2 == 0 ? random() : random() % 4 == 0 ? random() : 0);
    if (!bytes.empty()) bytes[0] = static_cast<std::uint8_t>(bytes[0] | 0xF0);  // a key group
    const auto setup = sample_setup(static_cast<PartMask>((random() & kAllParts) | kPoseOnly));
    MotionDecoder reader(setup, sample_seen(setup));
    const auto read = reader.decode(bytes);
    if (!read || !*read) continue;
    const MotionGroup& group = **read;
    EXPECT_EQ(std::ssize(states_of(group, setup.steps)), group.missing + group.pictures);
    EXPECT_TRUE(CodedLimits(setup.steps, setup.parts).hold(last_of(group)));
    const auto durations = durations_of(group, setup.format.frame_rate);
    EXPECT_EQ(std::ssize(durations), group.missing + group.pictures);
    EXPECT_TRUE(std::ranges::all_of(durations, [](auto d) { return d >= 1 && d <= kMaxDuration; }));
  }
}

// A key group whose header says that it has as many pictures as the group before.
TEST(MotionDecoder, RefusesAGroupOfNoPictures) {
  RangeEncoder encoder;
  AdaptiveBit other_count;
  encoder.raw_bit(kNotKey, true);
  code_first(encoder, 0, 0);
  encoder.bit(other_count, false);
  EXPECT_EQ(MotionDecoder(sample_setup(), {}).decode(encoder.finish()).error().code,
            ErrorCode::kInvalidStream);
}

}  // namespace
}  // namespace fbs
