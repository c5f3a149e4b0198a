#include "bitstream/motion/motion_decoder.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bitstream/entropy/range_coder.h"
#include "bitstream/track.h"
#include "tests/unit/bitstream/motion/motion_sample.h"

namespace fbs {
namespace {

TEST(MotionDecoder, KeyGroupDecodesWithoutTheGroupsBefore) {
  const auto setup = sample_setup();
  Sender sender(setup, 3);
  MotionDecoder late(setup, sender.seen);
  for (int g = 0; g < 6; ++g) {
    const MotionGroup group = sender.next({}, 20, g % 3 == 0);
    const auto payload = *sender.encoder.encode(group);
    if (g < 3) continue;
    EXPECT_EQ(*late.decode(payload), group);
  }
}

TEST(MotionDecoder, GroupThatIsNotKeyNeedsTheOneBefore) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionDecoder reader(setup, sender.seen);
  MotionGroup first = sender.next({}, 20);
  first.key = false;
  EXPECT_EQ(sender.encoder.encode(first).error().code, ErrorCode::kInvalidArgument);
  first.key = true;
  const auto one = *sender.encoder.encode(first);
  const auto two = *sender.encoder.encode(sender.next({}, 20));
  const MotionGroup third = sender.next({}, 20, true);
  const auto three = *sender.encoder.encode(third);
  EXPECT_EQ(reader.decode(two).error().code, ErrorCode::kInvalidStream);
  ASSERT_TRUE(reader.decode(one));
  EXPECT_FALSE(reader.decode({}));
  EXPECT_TRUE(reader.needs_key());
  EXPECT_EQ(reader.decode(two).error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(*reader.decode(three), third) << "a key group can follow an error";
  EXPECT_FALSE(reader.needs_key());
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
    at_rest += read ? 1 : 0;
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
    EXPECT_EQ(reader.needs_key(), !read.has_value());
    if (!read) {
      ++refused;
      continue;
    }
    EXPECT_TRUE(sender.encoder.limits().hold(last_of(*read)));
    if (read->key) {
      EXPECT_TRUE(MotionEncoder(setup, sender.seen).encode(*read)) << "what was read can be written";
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
    if (const auto read = reader.decode(bytes)) {
      EXPECT_EQ(std::ssize(states_of(*read, setup.steps)), read->pictures);
      EXPECT_TRUE(CodedLimits(setup.steps, setup.parts).hold(last_of(*read)));
    }
  }
}

// A key group whose header says that it has as many pictures as the group before.
TEST(MotionDecoder, RefusesAGroupOfNoPictures) {
  RangeEncoder encoder;
  AdaptiveBit other_count;
  encoder.raw_bit(kNotKey, true);
  encoder.bit(other_count, false);
  EXPECT_EQ(MotionDecoder(sample_setup(), {}).decode(encoder.finish()).error().code,
            ErrorCode::kInvalidStream);
}

}  // namespace
}  // namespace fbs
