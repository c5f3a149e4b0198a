#include "bitstream/pattern/pattern_packet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
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

PatternSyntax alone(PatternSyntax pattern) {
  pattern.alone = true;
  return pattern;
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
  EXPECT_FALSE(refused({alone(later_pattern())}));
  EXPECT_TRUE(refused({alone(later_pattern()), later_pattern()}));
  EXPECT_TRUE(refused({later_pattern(), alone(later_pattern())}));
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
  const auto code_of = [](const Bytes& payload) {
    const auto read = begun().decode(payload, sample_setup(), kPictures);
    return read ? ErrorCode::kInternal : read.error().code;
  };
  auto wide = sample_setup();
  wide.patterns = 7;
  EXPECT_EQ(code_of(later_packet({later_pattern(5)}, wide)), ErrorCode::kInternal) << "the last slot";
  EXPECT_EQ(code_of(later_packet({later_pattern(6)}, wide)), ErrorCode::kTooLarge) << "a slot after it";
  EXPECT_EQ(code_of(later_packet({alone(later_pattern(6))}, wide)), ErrorCode::kTooLarge);
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

TEST(PatternPacket, NothingIsReadBeforeTheFirstPattern) {
  for (const PatternSyntax& pattern : {later_pattern(), alone(later_pattern())})
    EXPECT_FALSE(PatternPacketReader().decode(later_packet({pattern}), sample_setup(), kPictures));
}

/// A scene: its first pattern, and pairs of one in the chain and one alone.
struct Packets {
  explicit Packets(int pairs = 4) {
    std::mt19937 random(6);
    PatternPacketWriter writer;
    const auto add = [&](const Patterns& more) {
      patterns.push_back(more);
      payloads.push_back(*writer.encode(more, sample_setup(), patterns.size() == 1 ? 0 : kPictures));
    };
    add({first_pattern()});
    for (int k = 0; k < pairs; ++k) {
      add(random_packet(random, 2, 60));
      add({alone(random_packet(random, 1, 60)[0])});
    }
  }
  std::vector<Patterns> patterns;
  std::vector<Bytes> payloads;
};

/// What a reader makes of a packet: nothing for an error.
std::optional<Patterns> read(PatternPacketReader& reader, const Bytes& payload, int pictures = kPictures) {
  const auto out = reader.decode(payload, sample_setup(), pictures);
  return out ? std::optional(*out) : std::nullopt;
}

TEST(PatternPacket, OneThatIsAloneNeedsTheFirstPatternOnly) {
  const Packets s(20);
  PatternPacketReader all, few = begun();
  for (std::size_t k = 0; k < s.payloads.size(); ++k) {
    EXPECT_EQ(read(all, s.payloads[k]), s.patterns[k]) << "between those of the chain";
    if (k == 0 || k % 2 != 0) continue;
    EXPECT_EQ(read(few, s.payloads[k]), s.patterns[k]) << "without the chain";
    EXPECT_EQ(later_packet(s.patterns[k]), s.payloads[k]);
  }
}

TEST(PatternPacket, LossOfOneInTheChainCostsTheChainOnly) {
  const Packets s;
  PatternPacketReader reader = begun();
  EXPECT_EQ(read(reader, s.payloads[1]), s.patterns[1]);
  for (std::size_t k = 4; k < s.payloads.size(); ++k)  // without 3
    EXPECT_EQ(read(reader, s.payloads[k]), k % 2 == 0 ? s.patterns[k] : Patterns{}) << k;
  EXPECT_EQ(read(reader, s.payloads[0]), s.patterns[0]);
  EXPECT_EQ(read(reader, s.payloads[1]), s.patterns[1]) << "another scene has another chain";
}

TEST(PatternPacket, LossOfOneThatIsAloneCostsNoOther) {
  const Packets s;
  PatternPacketReader reader = begun();
  for (const std::size_t k : {1U, 3U, 4U, 4U, 5U, 7U}) EXPECT_EQ(read(reader, s.payloads[k]), s.patterns[k]);
}

TEST(PatternPacket, OneInTheChainComesOnceAndInItsOrder) {
  const Packets s;
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{1, 1}, {1, 5, 3}}) {
    PatternPacketReader reader = begun();
    EXPECT_EQ(read(reader, s.payloads[order[0]]), s.patterns[order[0]]);
    for (std::size_t k = 1; k < order.size(); ++k) EXPECT_EQ(read(reader, s.payloads[order[k]]), Patterns{});
  }
}

// SPEC 4.4: the place of a picture among those with a state is another if motion is missing.
TEST(PatternPacket, OneInTheChainNeedsAllStates) {
  const Packets s;
  for (const int pictures : {0, kPictures - 20, kPictures + 1}) {
    PatternPacketReader reader = begun();
    EXPECT_EQ(read(reader, s.payloads[1], pictures), Patterns{});
    EXPECT_EQ(read(reader, s.payloads[2], pictures), s.patterns[2]) << "alone";
    EXPECT_EQ(read(reader, s.payloads[3]), Patterns{}) << "the chain is broken";
  }
}

TEST(PatternPacket, OneThatIsAloneHasItsPictureHoweverManyHaveAState) {
  const int pictures = 20000, oldest = first_with_state(pictures);
  for (const int picture : {oldest, oldest + 100, pictures - 1}) {
    const Patterns one = {alone(later_pattern(3, picture))};
    const Bytes payload = *PatternPacketWriter().encode(one, sample_setup(), pictures);
    for (const int known : {picture - 2000, picture + 1, pictures + 1000}) {
      PatternPacketReader reader = begun();
      EXPECT_EQ(read(reader, payload, known), one) << picture << ' ' << known;
    }
  }
}

TEST(PatternPacket, AnErrorBreaksTheChainOnlyWhereItIs) {
  const Packets s;
  auto wide = sample_setup();
  wide.patterns = 7;
  PatternPacketReader reader = begun();
  EXPECT_EQ(read(reader, s.payloads[1]), s.patterns[1]);
  EXPECT_EQ(read(reader, later_packet({alone(later_pattern(6))}, wide)), std::nullopt);
  EXPECT_EQ(read(reader, s.payloads[3]), s.patterns[3]);
  reader = begun();
  EXPECT_EQ(read(reader, later_packet({later_pattern(6)}, wide)), std::nullopt);
  EXPECT_EQ(read(reader, s.payloads[1]), Patterns{}) << "contexts are lost";
  EXPECT_EQ(read(reader, s.payloads[2]), s.patterns[2]);
  reader = begun();
  reader.lose();
  EXPECT_EQ(read(reader, s.payloads[1]), Patterns{});
  EXPECT_EQ(read(reader, s.payloads[2]), s.patterns[2]);
}

/// Likely bits cost next to nothing: a small packet could hold any number of patterns.
TEST(PatternPacket, HasNoMorePatternsThanAStore) {
  PatternMemory memory;
  const PatternSyntax pattern = later_pattern();
  memory.add(first_pattern());
  RangeEncoder first, encoder;
  first.bit(memory.has_length, false);
  write_open_frame(first, memory, first_pattern());
  memory.packets = 1;
  encoder.raw_bit(kNotKey, false);
  encoder.raw_bit(kNotKey, false);
  code_chain(encoder, memory, kPictures);
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
  const Bytes later = later_packet(random_packet(random, 5, 30)),
              lone = later_packet({alone(later_pattern())});
  for (int i = 0; i < 6000; ++i) {
    Bytes payload = i % 3 == 0 ? first : i % 3 == 1 ? later : lone;
    for (unsigned k = 1 + random() % 6; k > 0; --k)
      payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
    PatternPacketReader reader = begun();
    const auto read = reader.decode(payload, sample_setup(), kPictures);
    if (!read || read->empty()) continue;
    std::size_t bytes = 0;
    for (const PatternSyntax& p : *read) bytes += p.av1.size();
    EXPECT_LE(bytes, payload.size() + kMaxVirtualBytes + read->size() * kHeaderBytes);
    const bool ahead = read->front().picture >= kPictures;  // alone, of a picture whose motion may be missing
    EXPECT_TRUE(PatternPacketWriter().encode(*read, sample_setup(), kPictures) || ahead);
  }
}

// A first pattern that says it is alone would leave the writer without a first pattern.
TEST(PatternPacket, FirstPatternIsNotAlone) {
  EXPECT_FALSE(PatternPacketWriter().encode(Patterns{alone(first_pattern())}, sample_setup(), 0));
}

}  // namespace
}  // namespace fbs
