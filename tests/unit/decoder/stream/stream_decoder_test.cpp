#include "decoder/stream/stream_decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/unit/decoder/stream/stream_writer.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

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

TEST(StreamDecoder, DrawsAStateOfTheCallersAndKeepsItsOwn) {
  StreamDecoder decoder;
  Picture own, same, turned, after;
  EXPECT_EQ(decoder.render_state({}, std::nullopt, own).error().code, ErrorCode::kInvalidArgument);
  decoder.feed(sample().bytes);
  for (int k = 0; k < 5; ++k) ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
  ASSERT_TRUE(decoder.render(own));
  ASSERT_TRUE(decoder.render_state(decoder.state(), std::nullopt, same));
  EXPECT_EQ(own, same);
  State state = decoder.state();
  state.pose[kRoll] += 2000;
  ASSERT_TRUE(decoder.render_state(state, std::nullopt, turned));
  EXPECT_NE(own, turned);
  ASSERT_TRUE(decoder.render(after));
  EXPECT_EQ(own, after);
}

TEST(StreamDecoder, DrawsFromOnePatternAloneWhateverTheModes) {
  Writer w;
  w.setup(setup_of(2)).geometry().surround().pattern();
  w.motion(0, 10, true).pattern(face_picture(3), 1, 4).blend(10, BlendMode::kStillBefore);
  StreamDecoder decoder;
  decoder.feed(w.bytes);
  ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
  State plain = decoder.state();
  plain.blend.fill(BlendMode::kByTime);  // of the first picture: all from the first pattern, warped
  Picture by_time, first, second, none;
  ASSERT_TRUE(decoder.render_state(plain, std::nullopt, by_time));
  ASSERT_TRUE(decoder.render_state(decoder.state(), 0, first));
  ASSERT_TRUE(decoder.render_state(decoder.state(), 1, second));
  EXPECT_EQ(first, by_time);
  EXPECT_NE(first, second);
  EXPECT_EQ(decoder.render_state(decoder.state(), 2, none).error().code, ErrorCode::kInvalidArgument);
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
  w.scene({}, 5);
  w.setup(setup_at({5, 15000})).pattern(face_picture(2)).motion(3, 6, true);  // nobody there any more
  w.scene({8, 24000}, 5);
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

TEST(StreamDecoder, DrawsIntoTheCallersMemory) {
  for (const int threads : {1, 2}) {
    StreamDecoder decoder;
    decoder.use_threads(threads);
    decoder.feed(sample().bytes);
    ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
    Picture expected, out(kWidth, kHeight), small(16, 16);
    const Picture untouched = small;
    ASSERT_TRUE(decoder.render(expected));
    ASSERT_TRUE(decoder.render(PictureView(out)));
    EXPECT_EQ(out, expected) << threads;
    EXPECT_EQ(decoder.render(PictureView(small)).error().code, ErrorCode::kInvalidArgument) << threads;
    EXPECT_EQ(small, untouched) << threads;
    ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
    EXPECT_EQ(decoder.render(PictureView(small)).error().code, ErrorCode::kInvalidArgument) << threads;
    ASSERT_TRUE(decoder.render(small)) << threads;
    EXPECT_EQ(small.width(), kWidth) << "a picture takes the video's size";
  }
}

// SPEC 6: of several before pattern 0 the last counts; what comes behind it changes nothing.
TEST(StreamDecoder, GeometryIsFixedByPatternZero) {
  Writer plain, late, twice;
  Geometry other = toy_geometry();
  for (glm::ivec3& p : other.positions) p.x += p.x / 4;
  plain.setup().geometry().surround(4).pattern().motion(0, 5, true);
  late.setup().geometry().surround(4).pattern().packet(PacketType::kGeometry,
                                                       encode_geometry(other)->payload);
  late.surround(4).motion(0, 5, true);
  twice.setup().surround(0).geometry().geometry().surround(4).pattern().motion(0, 5, true);
  const auto expected = played(plain.bytes).pictures;
  EXPECT_EQ(played(late.bytes).pictures, expected);
  EXPECT_EQ(played(twice.bytes).pictures, expected);
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
  longer.insert(longer.end(),
                {1, 0, 0, 0, 3, 4});  // one pattern of full contrasts, and what a later version has
  Writer w;
  PacketReader reader;
  reader.feed(sample().bytes);
  reader.close();
  for (auto read = reader.next(); read->status == ReadStatus::kPacket; read = reader.next()) {
    const auto& [type, payload] = std::pair(read->packet.type, read->packet.payload);
    w.packet(type, type == PacketType::kSetup ? longer : Bytes(payload.begin(), payload.end()));
  }
  const Played result = played(w.bytes);
  EXPECT_TRUE(result.errors.empty());
  EXPECT_EQ(result.pictures, played(sample().bytes).pictures);
}

}  // namespace
}  // namespace fbs
