#include "bitstream/pattern/pattern_packet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Patterns = std::vector<PatternSyntax>;

constexpr int kPictures = 400;  // pictures with a state

PatternSyntax first_pattern(Bytes frame = {0x12, 0x00, 0x0A}) {
  PatternSyntax pattern;
  pattern.state[kYaw] = -2;
  pattern.state[kShiftX] = 40;
  pattern.state[kLogScale] = 900;
  pattern.state[kFirstCoefficient] = -9;
  pattern.state.back() = 4;
  pattern.av1 = std::move(frame);
  return pattern;
}

PatternSyntax later_pattern(std::int32_t slot = 1, std::int32_t picture = 300, Bytes frame = {0x32, 0x00}) {
  return {slot, picture, {}, std::move(frame)};
}

Setup sample_setup() {
  Setup setup;
  setup.patterns = 6;
  setup.format.width = 352;
  setup.format.height = 288;
  return setup;
}

Bytes first_packet() {
  return *encode_first_pattern(first_pattern(), sample_setup());
}

/// A frame like libaom's: a header that others share, and data.
Bytes random_frame(std::mt19937& random, std::size_t size) {
  Bytes frame = {0x30, 0x30, 0x02, 0x40, 0x0F, 0x00, 0x81, 0x06, 0x99, 0xC0};
  while (frame.size() < size) frame.push_back(static_cast<std::uint8_t>(random()));
  frame.resize(size);
  return frame;
}

Patterns random_packet(std::mt19937& random, std::size_t count, std::size_t largest) {
  Patterns out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(later_pattern(random() % sample_setup().patterns, 1 + random() % (kPictures - 1),
                                random_frame(random, 1 + random() % largest)));
  return out;
}

TEST(PatternPacket, RoundTripsPacketsOfAnyNumberOfPatterns) {
  std::mt19937 random(1);
  for (const std::size_t largest : {3u, 25u, 400u}) {
    PatternPacketWriter writer;
    PatternPacketReader reader;
    for (int i = 0; i < 300; ++i) {
      const bool first = i % 60 == 0;
      const Patterns patterns = first ? Patterns{first_pattern(random_frame(random, 1 + random() % largest))}
                                      : random_packet(random, 1 + random() % (i % 7 == 0 ? 64 : 4), largest);
      const auto payload = writer.encode(patterns, sample_setup(), kPictures);
      ASSERT_TRUE(payload) << payload.error().text;
      const auto read = reader.decode(*payload, sample_setup(), kPictures);
      ASSERT_TRUE(read) << read.error().text;
      ASSERT_EQ(*read, patterns) << i;
    }
  }
}

// Lengths 1..40 of frames of zeros and ones: where the end of the code would end them elsewhere, their length
// is sent.
TEST(PatternPacket, RoundTripsFramesThatCostNextToNothing) {
  for (const std::uint8_t byte : {0x00, 0xFF}) {
    PatternPacketWriter writer;
    PatternPacketReader reader;
    for (std::size_t size = 1; size <= 40; ++size) {
      for (int again = 0; again < 20; ++again) {
        const Patterns patterns = {size == 1 && again == 0 ? first_pattern(Bytes(1, byte))
                                                           : later_pattern(1, 300, Bytes(size, byte))};
        const auto payload = writer.encode(patterns, sample_setup(), kPictures);
        const auto read = reader.decode(*payload, sample_setup(), kPictures);
        ASSERT_TRUE(read) << read.error().text;
        ASSERT_EQ(*read, patterns) << size;
      }
    }
  }
}

TEST(PatternPacket, UsualPatternsCostFewBytesBesideTheirData) {
  std::mt19937 random(2);
  PatternPacketWriter writer;
  ASSERT_TRUE(writer.encode(Patterns{first_pattern()}, sample_setup(), 0));
  std::size_t bytes = 0;
  for (int k = 1; k <= 5; ++k)
    bytes =
        writer
            .encode(Patterns{later_pattern(k, 60 * k, random_frame(random, 110))}, sample_setup(), 60 * k + 1)
            ->size();
  EXPECT_LE(bytes, 104U) << "of 100 bytes that cannot be compressed";
}

TEST(PatternPacket, FirstPatternForgetsTheSceneBefore) {
  std::mt19937 random(3);
  PatternPacketWriter writer;
  ASSERT_TRUE(writer.encode(Patterns{first_pattern()}, sample_setup(), 0));
  ASSERT_TRUE(writer.encode(random_packet(random, 10, 50), sample_setup(), kPictures));
  EXPECT_EQ(*writer.encode(Patterns{first_pattern()}, sample_setup(), 0), first_packet());
}

TEST(PatternPacket, CopyOfAWriterContinuesAlone) {
  std::mt19937 random(4);
  PatternPacketWriter writer;
  ASSERT_TRUE(writer.encode(Patterns{first_pattern()}, sample_setup(), 0));
  PatternPacketWriter copy = writer;
  const Patterns next = random_packet(random, 3, 50);
  ASSERT_TRUE(copy.encode(random_packet(random, 20, 50), sample_setup(), kPictures));
  PatternPacketReader reader;
  ASSERT_TRUE(reader.decode(first_packet(), sample_setup(), 0));
  EXPECT_EQ(*reader.decode(*writer.encode(next, sample_setup(), kPictures), sample_setup(), kPictures), next);
}

TEST(PatternPacket, RefusesWhatBreaksALimit) {
  const auto code_of = [](const std::function<void(PatternSyntax&)>& breaks) {
    PatternSyntax pattern = first_pattern();
    pattern.state.back() = 0;  // gaze, is not sent
    breaks(pattern);
    auto setup = sample_setup();
    setup.parts = static_cast<PartMask>(mask_of(PartId::kPose) | mask_of(PartId::kMouth));
    const auto payload = PatternPacketWriter().encode(Patterns{pattern}, setup, kPictures);
    return payload ? ErrorCode::kInternal : payload.error().code;
  };
  EXPECT_EQ(code_of([](PatternSyntax&) {}), ErrorCode::kInternal) << "all else is in order";
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.slot = 1; }), ErrorCode::kInvalidArgument) << "of picture 0";
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.slot = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.picture = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.picture = kPictures; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) {
              p.picture = 1;
              p.slot = sample_setup().patterns;
            }),
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.av1.clear(); }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.av1.resize(kMaxPayload); }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kYaw] = 1 << 20; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kLogScale] = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kPoseCount] = 1; }), ErrorCode::kInvalidArgument);
}

TEST(PatternPacket, RefusesPacketsOfNoneTooManyOrMoreThanTheFirst) {
  const auto refused = [](const Patterns& patterns) {
    return !PatternPacketWriter().encode(patterns, sample_setup(), kPictures);
  };
  EXPECT_TRUE(refused({}));
  EXPECT_FALSE(refused(Patterns(kMaxPatterns, later_pattern())));
  EXPECT_TRUE(refused(Patterns(kMaxPatterns + 1, later_pattern())));
  EXPECT_TRUE(refused({first_pattern(), later_pattern()}));
}

TEST(PatternPacket, FirstPatternIsOfSlotZeroAndPictureZero) {
  const auto accepted = [](std::int32_t slot, std::int32_t picture) {
    PatternSyntax pattern = first_pattern();
    pattern.slot = slot;
    pattern.picture = picture;
    return encode_first_pattern(pattern, sample_setup()).has_value();
  };
  EXPECT_TRUE(accepted(0, 0));
  EXPECT_FALSE(accepted(1, 0));
  EXPECT_FALSE(accepted(0, 1));
}

TEST(PatternPacket, TooManyBytesLeaveTheWriterAsItWas) {
  PatternPacketWriter writer;
  ASSERT_TRUE(writer.encode(Patterns{first_pattern()}, sample_setup(), 0));
  PatternPacketWriter same = writer;
  const Bytes half(kMaxPayload / 2 + 100, 1);
  ASSERT_FALSE(writer.encode(Patterns{later_pattern(1, 300, half), later_pattern(2, 301, half)},
                             sample_setup(), kPictures));
  EXPECT_EQ(*writer.encode(Patterns{later_pattern()}, sample_setup(), kPictures),
            *same.encode(Patterns{later_pattern()}, sample_setup(), kPictures));
}

/// A reader that has read a scene's first pattern.
PatternPacketReader begun() {
  PatternPacketReader reader;
  EXPECT_TRUE(reader.decode(first_packet(), sample_setup(), 0));
  return reader;
}

/// A later packet, as a writer with `setup` writes it.
Bytes later_packet(const Patterns& patterns, const Setup& setup = sample_setup()) {
  PatternPacketWriter writer;
  EXPECT_TRUE(writer.encode(Patterns{first_pattern()}, setup, 0));
  return *writer.encode(patterns, setup, kPictures);
}

TEST(PatternPacket, NamesWhatIsWrong) {
  const auto code_of = [](const Bytes& payload, int pictures = kPictures) {
    const auto read = begun().decode(payload, sample_setup(), pictures);
    return read ? ErrorCode::kInternal : read.error().code;
  };
  auto wide = sample_setup();
  wide.patterns = 7;
  EXPECT_EQ(code_of(later_packet({later_pattern(5)}, wide)), ErrorCode::kInternal) << "the last slot";
  EXPECT_EQ(code_of(later_packet({later_pattern(6)}, wide)), ErrorCode::kTooLarge) << "a slot after it";
  EXPECT_EQ(code_of(later_packet({later_pattern()}), 0), ErrorCode::kInvalidStream)
      << "no picture has a state";
  const Bytes two = later_packet({later_pattern(1, 300, Bytes(1, 0)), later_pattern(2, 200, Bytes(2, 0))});
  EXPECT_EQ(code_of(two), ErrorCode::kInternal);
  EXPECT_EQ(code_of({0xFF, 0xFF, 0xFF, 0xFF}), ErrorCode::kInvalidStream) << "no range code";
}

TEST(PatternPacket, AFrameWhoseLengthIsSentMayNotEndEarly) {
  std::mt19937 random(5);
  const Patterns two = {later_pattern(1, 300, random_frame(random, 200)),
                        later_pattern(2, 200, random_frame(random, 100))};
  Bytes payload = later_packet(two);
  payload.resize(150);
  const auto read = begun().decode(payload, sample_setup(), kPictures);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kTruncated);
}

TEST(PatternPacket, NothingIsReadBeforeTheFirstPatternOrBehindAnError) {
  const Bytes later = later_packet({later_pattern()});
  EXPECT_FALSE(PatternPacketReader().decode(later, sample_setup(), kPictures));
  PatternPacketReader reader = begun();
  EXPECT_FALSE(reader.decode(later, sample_setup(), 0));
  EXPECT_FALSE(reader.decode(later, sample_setup(), kPictures)) << "contexts are lost";
  EXPECT_TRUE(reader.decode(first_packet(), sample_setup(), 0));
}

/// Likely bits cost next to nothing: a small packet could hold any number of patterns.
TEST(PatternPacket, HasNoMorePatternsThanAStore) {
  PatternMemory memory;
  const PatternSyntax pattern = later_pattern();
  memory.add(first_pattern());
  RangeEncoder first, encoder;
  first.bit(memory.has_length, false);
  write_open_frame(first, memory, first_pattern());
  encoder.raw_bit(kNotKey, false);
  for (int k = 0; k <= kMaxPatterns; ++k) {
    ASSERT_TRUE(code_place(encoder, memory, kPictures, pattern));
    memory.add(pattern);
    encoder.bit(memory.has_length, true);
    code_frame(encoder, memory, pattern);
    encoder.bit(memory.has_next, k < kMaxPatterns);
  }
  PatternPacketReader reader;
  ASSERT_TRUE(reader.decode(first_packet(), sample_setup(), 0));
  const auto read = reader.decode(encoder.finish(), sample_setup(), kPictures);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kTooLarge);
}

TEST(PatternPacket, SurvivesRandomBytes) {
  std::mt19937 random(8);
  const Bytes first = first_packet();
  const Bytes later = later_packet(random_packet(random, 5, 30));
  for (int i = 0; i < 5000; ++i) {
    Bytes payload = i % 2 == 0 ? first : later;
    for (unsigned k = 1 + random() % 6; k > 0; --k)
      payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
    PatternPacketReader reader = begun();
    const auto read = reader.decode(payload, sample_setup(), kPictures);
    if (!read) continue;
    std::size_t bytes = 0;
    for (const PatternSyntax& p : *read) bytes += p.av1.size();
    EXPECT_LE(bytes, payload.size() + kMaxVirtualBytes + read->size() * kHeaderBytes);
    EXPECT_TRUE(PatternPacketWriter().encode(*read, sample_setup(), kPictures));
  }
}

}  // namespace
}  // namespace fbs
