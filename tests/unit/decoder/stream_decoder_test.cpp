#include "decoder/stream_decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/pattern_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/track.h"
#include "encoder/patterns/pattern_encoder.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kWidth = 96, kHeight = 80;

Setup setup_of() {
  Setup setup = toy_setup(kWidth, kHeight);
  setup.format.frame_rate = {30, 1};
  return setup;
}

CodedState coded_at(int time) {
  CodedState s = coded_pose(toy_state(48, 34));
  s[kLogScale] = 4 * 4096;
  s[kYaw] = time * 150;
  s[kShiftX] += time * 20;
  s[kPoseCount + kLightOffset] = time * 9;
  s[kFirstCoefficient] = time * 25;
  return s;
}

Picture face_picture(int seed) {
  Picture p(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      p.y.row(y)[x] =
          static_cast<std::uint8_t>(120 + 50 * std::sin(x * 0.2 + seed) + 50 * std::cos(y * 0.17));
  return p;
}

/// Writes streams packet by packet, in any order.
class Writer {
 public:
  Writer() { write_signature(bytes); }

  Writer& packet(PacketType type, const Result<Bytes>& payload) {
    EXPECT_TRUE(payload);
    begins.push_back(bytes.size());
    write_packet(bytes, type, *payload);
    return *this;
  }
  Writer& setup(const Setup& s = setup_of()) {
    setup_ = s;
    motion_.emplace(s, coded_at(0));
    patterns_ = 0;
    av1_.emplace(*PatternEncoder::create(s.format, 50));
    return packet(PacketType::kSetup, encode_setup(s));
  }
  Writer& geometry() { return packet(PacketType::kGeometry, encode_geometry(toy_geometry())->payload); }
  Writer& surround(int follow = 2) {
    return packet(PacketType::kSurround, encode_surround(even_surround(6, 5, follow)));
  }
  Writer& pattern(const Picture& picture = face_picture(0)) {
    const PatternSyntax syntax{patterns_++, coded_at(0), *av1_->encode(picture)};
    return packet(PacketType::kPattern, encode_pattern(syntax, setup_));
  }
  /// Pictures `from`..`end` - 1.
  Writer& motion(int from, int end, bool key = false, std::vector<std::uint32_t> durations = {}) {
    std::vector<CodedState> states;
    for (int t = from; t < end; ++t) states.push_back(coded_at(t));
    MotionGroup group = knots_everywhere(motion_->anchor(key), states, setup_.parts);
    group.key = key;
    group.durations = std::move(durations);
    return packet(PacketType::kMotion, motion_->encode(group));
  }
  Writer& end(std::uint64_t pictures) { return packet(PacketType::kEnd, encode_end({pictures})); }

  Bytes bytes;
  std::vector<std::size_t> begins;

 private:
  Setup setup_;
  std::optional<MotionEncoder> motion_;
  std::optional<PatternEncoder> av1_;
  int patterns_ = 0;
};

/// Four groups of five pictures; the third is a key group.
const Writer& sample() {
  static const Writer w = [] {
    Writer s;
    s.setup().geometry().surround().pattern();
    s.motion(0, 5, true).motion(5, 10).motion(10, 15, true).motion(15, 20).end(20);
    return s;
  }();
  return w;
}

/// What a decoder returns for a stream.
struct Played {
  std::vector<Picture> pictures;
  std::vector<std::uint32_t> durations;
  std::vector<Error> errors;
  ByteCount bytes;
  std::optional<std::uint64_t> announced;
};

/// Plays what has arrived; returns true at the end.
bool play(StreamDecoder& decoder, Played& result) {
  for (int guard = 0; guard < 10000; ++guard) {
    const auto status = decoder.next();
    if (!status) {
      EXPECT_NE(status.error().code, ErrorCode::kInternal) << status.error().text;
      result.errors.push_back(status.error());
      continue;
    }
    result.bytes = decoder.bytes();
    result.announced = decoder.announced_pictures();
    if (*status == DecodeStatus::kEnd) return true;
    if (*status == DecodeStatus::kNeedMore) return false;
    result.pictures.emplace_back();
    EXPECT_TRUE(decoder.render(result.pictures.back()));
    result.durations.push_back(decoder.duration());
  }
  ADD_FAILURE() << "a decoder that never ends";
  return true;
}

Played played(std::span<const std::uint8_t> bytes) {
  StreamDecoder decoder;
  decoder.feed(bytes);
  decoder.close();
  Played result;
  EXPECT_TRUE(play(decoder, result));
  return result;
}

std::uint64_t sum_of(const ByteCount& b) {
  return b.geometry + b.patterns + b.motion + b.other;
}

TEST(StreamDecoder, PlaysEveryPicture) {
  const Played result = played(sample().bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 20u);
  EXPECT_EQ(result.announced, 20u);
  for (const Picture& p : result.pictures) {
    EXPECT_EQ(p.width(), kWidth);
    EXPECT_EQ(p.height(), kHeight);
  }
  for (std::size_t i = 1; i < 20; ++i) EXPECT_NE(result.pictures[i], result.pictures[i - 1]) << i;
}

TEST(StreamDecoder, CountsEveryByteOnce) {
  const auto& b = sample().begins;
  const ByteCount bytes = played(sample().bytes).bytes;
  EXPECT_EQ(bytes.total, sample().bytes.size());
  EXPECT_EQ(sum_of(bytes), bytes.total);
  EXPECT_EQ(bytes.geometry, b[3] - b[1]);
  EXPECT_EQ(bytes.patterns, b[4] - b[3]);
  EXPECT_EQ(bytes.motion, b[8] - b[4]);
  EXPECT_EQ(bytes.startup, b[5]) << "setup to first motion packet";
}

TEST(StreamDecoder, CountsMotionBitsOnlyOnRequest) {
  const auto bits_of = [](bool counts) {
    StreamDecoder decoder;
    if (counts) decoder.count_motion_bits();
    decoder.feed(sample().bytes);
    decoder.close();
    while (*decoder.next() == DecodeStatus::kPicture) {
    }
    const PartBitsX256& bits = decoder.motion_bits();
    return std::accumulate(bits.begin(), bits.end(), 0.0) / 256;
  };
  EXPECT_EQ(bits_of(false), 0);
  // Packet headers, checks and the ends of codes are some seven bytes for each of the four groups.
  const auto& b = sample().begins;
  EXPECT_NEAR(bits_of(true), 8.0 * static_cast<double>(b[8] - b[4]), 4 * 7 * 8);
  EXPECT_GT(bits_of(true), 100);
}

TEST(StreamDecoder, FirstPictureNeedsNoMoreThanTheStartup) {
  const std::size_t startup = sample().begins[5];
  StreamDecoder decoder;
  decoder.feed(std::span(sample().bytes).first(startup - 1));
  EXPECT_EQ(*decoder.next(), DecodeStatus::kNeedMore);
  decoder.feed(std::span(sample().bytes).subspan(startup - 1, 1));
  EXPECT_EQ(*decoder.next(), DecodeStatus::kPicture);
}

TEST(StreamDecoder, BytesMayComeOneByOne) {
  StreamDecoder decoder;
  Played result;
  for (const std::uint8_t byte : sample().bytes) {
    decoder.feed({&byte, 1});
    EXPECT_FALSE(play(decoder, result));
  }
  decoder.close();
  EXPECT_TRUE(play(decoder, result));
  EXPECT_TRUE(result.errors.empty());
  EXPECT_EQ(result.pictures, played(sample().bytes).pictures);
}

TEST(StreamDecoder, StreamMayBeCutAnywhere) {
  const Played whole = played(sample().bytes);
  for (std::size_t size = 0; size < sample().bytes.size(); size += 37) {
    const Played result = played(std::span(sample().bytes).first(size));
    ASSERT_LE(result.errors.size(), 1u) << size;
    const bool at_packet =
        std::find(sample().begins.begin() + 1, sample().begins.end(), size) != sample().begins.end();
    EXPECT_EQ(result.errors.empty(), at_packet) << size;
    if (!result.errors.empty()) {
      EXPECT_EQ(result.errors[0].code, size == 0 ? ErrorCode::kNotFbs : ErrorCode::kTruncated) << size;
    }
    // Every whole motion packet still decodes.
    std::size_t expected = 0;
    for (std::size_t k = 4; k < 8; ++k) expected += sample().begins[k + 1] <= size ? 5 : 0;
    ASSERT_EQ(result.pictures.size(), expected) << size;
    EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), whole.pictures.begin())) << size;
  }
}

TEST(StreamDecoder, GoesOnBehindAFlippedBit) {
  const Played whole = played(sample().bytes);
  for (std::size_t bit = 4 * 8; bit < sample().bytes.size() * 8; bit += 53) {
    Bytes bytes = sample().bytes;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1U << bit % 8);
    const Played result = played(bytes);
    ASSERT_FALSE(result.errors.empty()) << bit;
    ASSERT_LE(result.pictures.size(), 20u);
    // Damage in a motion packet costs its pictures and those up to the next key group, no more.
    if (bit / 8 >= sample().begins[4] && bit / 8 < sample().begins[8]) {
      EXPECT_GE(result.pictures.size(), 10u) << bit;
      for (const Picture& p : result.pictures)
        EXPECT_NE(std::find(whole.pictures.begin(), whole.pictures.end(), p), whole.pictures.end())
            << "a wild picture";
    }
  }
}

TEST(StreamDecoder, ErrorsNameTheByteOfTheirPacket) {
  Bytes bytes = sample().bytes;
  bytes[sample().begins[5] + 3] ^= 1;
  const Played result = played(bytes);
  ASSERT_GE(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].byte_offset, sample().begins[5]);
}

TEST(StreamDecoder, LostGroupCostsThePicturesUpToTheNextKeyGroup) {
  Bytes bytes = sample().bytes;
  const auto at = [&](std::size_t packet) {
    return bytes.begin() + static_cast<std::ptrdiff_t>(sample().begins[packet]);
  };
  bytes.erase(at(4), at(5));  // the first group, key: the second cannot be read
  const Played result = played(bytes), whole = played(sample().bytes);
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  ASSERT_EQ(result.pictures.size(), 10u);
  EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), whole.pictures.begin() + 10));
}

/// The first error of a stream.
ErrorCode first_error(const Writer& w) {
  const Played result = played(w.bytes);
  EXPECT_FALSE(result.errors.empty());
  return result.errors.empty() ? ErrorCode::kInternal : result.errors[0].code;
}

TEST(StreamDecoder, OrderOfPacketsIsChecked) {
  EXPECT_EQ(first_error(Writer().packet(PacketType::kGeometry, encode_geometry(toy_geometry())->payload)),
            ErrorCode::kInvalidStream)
      << "before the setup";
  EXPECT_EQ(first_error(Writer().packet(PacketType::kMotion, Bytes{1})), ErrorCode::kInvalidStream);
  EXPECT_EQ(first_error(Writer().setup().geometry().motion(0, 3, true)), ErrorCode::kInvalidStream)
      << "no pattern";
  Writer late;
  late.setup();
  const PatternSyntax one{1, coded_at(0),
                          *PatternEncoder::create(setup_of().format, 50)->encode(face_picture(0))};
  EXPECT_EQ(first_error(late.packet(PacketType::kPattern, encode_pattern(one, setup_of()))),
            ErrorCode::kInvalidStream)
      << "pattern 1 comes first";
}

TEST(StreamDecoder, EmptyAndUnfinishedStreamsAreErrors) {
  EXPECT_EQ(played({}).errors.at(0).code, ErrorCode::kNotFbs);
  EXPECT_EQ(played(Writer().bytes).errors.at(0).code, ErrorCode::kTruncated) << "a signature alone";
  EXPECT_TRUE(played(Writer().setup().geometry().surround().pattern().bytes).errors.empty())
      << "no picture is no fault";
}

TEST(StreamDecoder, AnotherSizeInsideAStreamIsUnsupported) {
  fbs::Setup other = setup_of();
  other.format.width += 2;
  Writer w;
  w.setup().geometry().surround().pattern().motion(0, 2, true).setup(other);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kUnsupported);
  EXPECT_EQ(result.pictures.size(), 2u);
}

TEST(StreamDecoder, UnknownPacketsAreSkipped) {
  Writer w;
  w.packet(static_cast<PacketType>(77), Bytes{1, 2, 3})
      .setup()
      .geometry()
      .packet(static_cast<PacketType>(200), Bytes(300));
  w.surround().pattern().motion(0, 5, true).packet(static_cast<PacketType>(0), Bytes{});
  w.motion(5, 10);
  const Played result = played(w.bytes), whole = played(sample().bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 10u);
  EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), whole.pictures.begin()));
  EXPECT_EQ(sum_of(result.bytes), w.bytes.size());
}

TEST(StreamDecoder, SceneWithoutGeometryShowsItsPattern) {
  Writer w;
  w.setup().pattern().motion(0, 4, true);
  const Played result = played(w.bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 4u);
  for (const Picture& p : result.pictures) EXPECT_EQ(p, result.pictures[0]);
}

// SPEC 6: a scene without a surround packet stands before still ground.
TEST(StreamDecoder, SceneWithoutSurroundStandsBeforeStillGround) {
  Writer w;
  w.setup().geometry().pattern().motion(0, 20, true);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.pictures.size(), 20u);
  EXPECT_NE(result.pictures[19], result.pictures[0]);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(result.pictures[19].y.row(2)[x], result.pictures[0].y.row(2)[x]);
}

TEST(StreamDecoder, NewSetupBeginsANewScene) {
  Writer w;
  w.setup().geometry().surround().pattern().motion(0, 5, true);
  w.setup().pattern(face_picture(2)).motion(3, 6, true);  // nobody there any more
  w.setup().geometry().surround().pattern().motion(0, 5, true);
  const Played result = played(w.bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 13u);
  EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.begin() + 5, result.pictures.begin() + 8));
  EXPECT_EQ(result.pictures[5], result.pictures[7]) << "the geometry of the scene before is forgotten";
}

TEST(StreamDecoder, NothingIsDrawnBeforeTheFirstPicture) {
  StreamDecoder decoder;
  Picture out;
  const auto refused = [&] {
    const auto drawn = decoder.render(out);
    return !drawn && drawn.error().code == ErrorCode::kInvalidArgument && out.empty();
  };
  EXPECT_TRUE(refused()) << "no stream at all";
  const std::span bytes(sample().bytes);
  for (std::size_t k = 1; k <= 4; ++k) {
    const std::size_t begin = k == 1 ? 0 : sample().begins[k - 1];
    decoder.feed(bytes.subspan(begin, sample().begins[k] - begin));
    ASSERT_EQ(*decoder.next(), DecodeStatus::kNeedMore);
    EXPECT_TRUE(refused()) << "packet " << k;
  }
  decoder.feed(bytes.subspan(sample().begins[4]));
  ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
  EXPECT_TRUE(decoder.render(out));
}

// The state of the old scene means nothing in the new one.
TEST(StreamDecoder, NothingIsDrawnAfterAnErrorBehindANewSetup) {
  for (const bool with_pattern : {false, true}) {
    Writer w;
    w.setup().geometry().surround().pattern().motion(0, 2, true).setup();
    if (with_pattern) w.geometry().pattern();
    w.packet(PacketType::kMotion, Bytes{});
    StreamDecoder decoder;
    decoder.feed(w.bytes);
    decoder.close();
    Picture out;
    for (int i = 0; i < 2; ++i) {
      ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
      ASSERT_TRUE(decoder.render(out));
    }
    ASSERT_FALSE(decoder.next());
    EXPECT_EQ(decoder.render(out).error().code, ErrorCode::kInvalidArgument) << with_pattern;
    EXPECT_EQ(decoder.render(PictureView(out)).error().code, ErrorCode::kInvalidArgument);
  }
}

TEST(StreamDecoder, DrawsIntoTheCallersMemory) {
  StreamDecoder decoder;
  decoder.feed(sample().bytes);
  ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
  Picture expected, out(kWidth, kHeight);
  ASSERT_TRUE(decoder.render(expected));
  ASSERT_TRUE(decoder.render(PictureView(out)));
  EXPECT_EQ(out, expected);
}

// SPEC 6: of several before pattern 0 the last counts; what comes behind it changes nothing.
TEST(StreamDecoder, GeometryIsFixedByPatternZero) {
  Writer plain, late, twice;
  plain.setup().geometry().surround(4).pattern().motion(0, 5, true);
  late.setup().geometry().surround(4).pattern().surround(0).geometry().motion(0, 5, true);
  twice.setup().surround(0).geometry().geometry().surround(4).pattern().motion(0, 5, true);
  const auto expected = played(plain.bytes).pictures;
  EXPECT_EQ(played(late.bytes).pictures, expected);
  EXPECT_EQ(played(twice.bytes).pictures, expected);
}

TEST(StreamDecoder, LaterPatternsAreDecodedAndNotDrawn) {
  Writer w;
  w.setup()
      .geometry()
      .surround()
      .pattern()
      .pattern(face_picture(1))
      .motion(0, 5, true)
      .pattern(face_picture(2))
      .motion(5, 10);
  const Played result = played(w.bytes), whole = played(sample().bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 10u);
  EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), whole.pictures.begin()));
}

TEST(StreamDecoder, GivesEachPicturesDuration) {
  Writer w;
  w.setup().geometry().surround().pattern().motion(0, 3, true).motion(3, 6, false, {3000, 9000, 1});
  EXPECT_EQ(played(w.bytes).durations, (std::vector<std::uint32_t>{3000, 3000, 3000, 3000, 9000, 1}));
}

TEST(StreamDecoder, DurationStaysInRangeAtTheSlowestRate) {
  fbs::Setup slow = setup_of();
  slow.format.frame_rate = {1, 4000000000U};
  Writer w;
  w.setup(slow).pattern().motion(0, 1, true);
  EXPECT_EQ(played(w.bytes).durations.at(0), kMaxDuration) << "SPEC 5.5";
}

TEST(StreamDecoder, SetupMayBeLongerThanThisVersionKnows) {
  Bytes longer = *encode_setup(setup_of());
  longer.insert(longer.end(), {1, 2, 3, 4});
  const Writer& s = sample();
  Writer w;
  w.packet(PacketType::kSetup, longer);
  w.bytes.insert(w.bytes.end(), s.bytes.begin() + static_cast<std::ptrdiff_t>(s.begins[1]), s.bytes.end());
  const Played result = played(w.bytes);
  EXPECT_TRUE(result.errors.empty());
  EXPECT_EQ(result.pictures, played(s.bytes).pictures);
}

TEST(StreamDecoder, DamagedAv1IsInvalid) {
  Writer w;
  w.setup().geometry();
  const PatternSyntax junk{0, coded_at(0), Bytes(50, 0xAB)};
  w.packet(PacketType::kPattern, encode_pattern(junk, setup_of()));
  const Played result = played(w.bytes);
  ASSERT_FALSE(result.errors.empty());
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  EXPECT_EQ(result.errors[0].byte_offset, w.begins[2]);
}

TEST(StreamDecoder, SurvivesPayloadsThatLieWithRightChecks) {
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    Bytes bytes;
    write_signature(bytes);
    for (std::size_t k = 0; k < sample().begins.size(); ++k) {
      const std::size_t begin = sample().begins[k];
      PacketReader reader;
      Bytes one;
      write_signature(one);
      const std::size_t end = k + 1 < sample().begins.size() ? sample().begins[k + 1] : sample().bytes.size();
      one.insert(one.end(), sample().bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                 sample().bytes.begin() + static_cast<std::ptrdiff_t>(end));
      reader.feed(one);
      reader.close();
      const auto packet = reader.next();
      ASSERT_TRUE(packet.has_value());
      Bytes payload(packet->packet.payload.begin(), packet->packet.payload.end());
      if (random() % 4 == 0 && !payload.empty())
        for (unsigned n = random() % 3; n < 3; ++n)
          payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
      write_packet(bytes, packet->packet.type, payload);
    }
    const Played result = played(bytes);
    EXPECT_LE(result.pictures.size(), 4u * kMaxGroupPictures);
  }
}

TEST(StreamDecoder, SurvivesRandomBytesBehindTheSignature) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    Bytes bytes;
    write_signature(bytes);
    for (unsigned n = random() % 600; n > 0; --n)
      bytes.push_back(static_cast<std::uint8_t>(random() % (i % 2 == 0 ? 256 : 8)));
    EXPECT_TRUE(played(bytes).pictures.empty());
  }
}

}  // namespace
}  // namespace fbs
