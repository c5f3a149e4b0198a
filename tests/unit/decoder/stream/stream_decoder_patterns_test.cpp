// Streams with several patterns. SPEC 6.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bitstream/entropy/range_coder.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/unit/decoder/stream/stream_writer.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

std::vector<ErrorCode> errors_of(const Writer& w) {
  std::vector<ErrorCode> out;
  for (const Error& e : played(w.bytes).errors) out.push_back(e.code);
  return out;
}

TEST(StreamDecoderPatterns, PicturesWaitForTheirBlend) {
  const Writer whole = [] {
    Writer w = begun();
    w.motion(0, 5, true).motion(5, 10).blend(3).blend(7);
    return w;
  }();
  StreamDecoder decoder;
  Played result;
  const auto feed = [&](std::size_t packet) {
    const std::size_t end = packet + 1 < whole.begins.size() ? whole.begins[packet + 1] : whole.bytes.size();
    const std::size_t begin = packet == 0 ? 0 : whole.begins[packet];
    decoder.feed(std::span(whole.bytes).subspan(begin, end - begin));
    EXPECT_FALSE(play(decoder, result));
    return result.pictures.size();
  };
  for (std::size_t packet = 0; packet < 6; ++packet) EXPECT_EQ(feed(packet), 0U) << packet;
  EXPECT_EQ(feed(6), 3U);
  EXPECT_EQ(feed(7), 10U);
  EXPECT_TRUE(result.errors.empty());
}

// What a live encoder learns about the surround takes effect between pictures.
TEST(StreamDecoderPatterns, ALaterSurroundDrawsThePicturesReleasedAfterIt) {
  const auto with_map = [](int follow) {
    Writer w;
    w.setup(setup_of(3)).geometry().surround(follow).pattern().motion(0, 5, true).motion(5, 10).blend(10);
    return played(w.bytes).pictures;
  };
  const auto before = with_map(0), after = with_map(4);
  ASSERT_NE(before[4], after[4]);
  Writer w;
  w.setup(setup_of(3)).geometry().surround(0).pattern().motion(0, 5, true).motion(5, 10).blend(4);
  w.surround(4).blend(6);
  const Played result = played(w.bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 10U);
  for (std::size_t t = 0; t < 10; ++t) EXPECT_EQ(result.pictures[t], t < 4 ? before[t] : after[t]) << t;
}

TEST(StreamDecoderPatterns, ALaterSurroundLeavesThePictureShownAsItIs) {
  Writer w;
  w.setup(setup_of(3)).geometry().surround(0).pattern().motion(0, 5, true).blend(5).surround(4);
  StreamDecoder decoder;
  Played result;
  play_through(decoder, w, result);
  Picture again;
  ASSERT_TRUE(decoder.render(again));
  EXPECT_EQ(again, result.pictures.back());
}

TEST(StreamDecoderPatterns, OnePatternInAStoreOfManyDrawsAsAlone) {
  Writer w = begun();
  w.motion(0, 5, true).motion(5, 10).blend(10);
  const Played result = played(w.bytes), alone = played(sample().bytes);
  ASSERT_EQ(result.pictures.size(), 10U);
  EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), alone.pictures.begin()));
}

TEST(StreamDecoderPatterns, LaterPatternIsSeenInTheStateOfItsPicture) {
  Writer w = begun();
  w.motion(0, 10, true).pattern(face_picture(1), 1, 7).pattern(face_picture(2), 2, 4).blend(10);
  StreamDecoder decoder;
  Played result;
  play_through(decoder, w, result);
  ASSERT_EQ(decoder.scene().patterns.size(), 3U);
  const auto expect_seen = [&](std::size_t slot, int number) {
    State expected = state_of(coded_at(number), setup_of().steps);
    expected.picture = number;
    EXPECT_EQ(decoder.scene().patterns[slot].seen, expected) << slot;
  };
  expect_seen(0, 0);
  expect_seen(1, 7);
  expect_seen(2, 4);
}

TEST(StreamDecoderPatterns, PatternsInOnePacketAreTakenInTheirOrder) {
  Writer apart = begun(), together = begun();
  apart.motion(0, 10, true).pattern(face_picture(1), 1, 7).pattern(face_picture(2), 2, 4);
  apart.pattern(face_picture(3), 1, 9).blend(10);
  together.motion(0, 10, true);
  std::vector<PatternSyntax> patterns = {{1, 7, {}, {}}, {2, 4, {}, {}}, {1, 9, {}, {}}};
  for (int k = 0; k < 3; ++k) patterns[k].av1 = together.frame(face_picture(k + 1));
  together.patterns(patterns).blend(10);
  EXPECT_LT(together.bytes.size() + 5, apart.bytes.size()) << "a packet costs four bytes, a length less";
  const Played result = played(together.bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 10U);
  EXPECT_EQ(result.pictures, played(apart.bytes).pictures);
}

TEST(StreamDecoderPatterns, RecordsShareTheBytesOfTheirPacket) {
  Writer w = begun();
  w.motion(0, 10, true);
  const Bytes one = w.frame(face_picture(1)), two = w.frame(face_picture(2));
  w.patterns({{1, 7, {}, one}, {2, 4, {}, two}}).blend(10);
  StreamDecoder decoder;
  decoder.record_patterns();
  Played result;
  play_through(decoder, w, result);
  const auto& records = decoder.pattern_records();
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[0].bytes, w.begins[4] - w.begins[3]);
  const double size = static_cast<double>(w.begins[6] - w.begins[5]);
  EXPECT_EQ(records[1].bytes + records[2].bytes, w.begins[6] - w.begins[5]);
  EXPECT_NEAR(static_cast<double>(records[1].bytes),
              size * static_cast<double>(one.size()) / static_cast<double>(one.size() + two.size()), 1);
  EXPECT_EQ(records[2].picture, 4U);
}

TEST(StreamDecoderPatterns, ModesOfTheBlendPacketAreUsed) {
  Writer w = begun();
  w.motion(0, 10, true).pattern(face_picture(1), 1, 7);
  w.blend(4, BlendMode::kStillBefore).blend(2, BlendMode::kStillAfter).blend(4);
  StreamDecoder decoder;
  Played result;
  play_through(decoder, w, result);
  ASSERT_EQ(result.pictures.size(), 10U);
  const auto& patterns = decoder.scene().patterns;
  for (std::size_t t = 0; t < 4; ++t) EXPECT_EQ(result.pictures[t], patterns[0].picture);
  for (std::size_t t = 4; t < 6; ++t) EXPECT_EQ(result.pictures[t], patterns[1].picture);
  EXPECT_NE(result.pictures[6], patterns[1].picture);
}

TEST(StreamDecoderPatterns, PictureIsDrawnFromThePatternsOfItsRelease) {
  Writer w = begun(2);
  w.motion(0, 10, true).pattern(face_picture(1), 1, 2).blend(3, BlendMode::kStillBefore);
  w.pattern(face_picture(5), 1, 3).blend(7, BlendMode::kStillBefore);
  StreamDecoder decoder;
  Played result;
  play_through(decoder, w, result);
  ASSERT_EQ(decoder.scene().patterns.size(), 2U);
  EXPECT_NE(result.pictures[2], decoder.scene().patterns[1].picture) << "that of its time has been replaced";
  EXPECT_NE(result.pictures[2], result.pictures[0]);
  EXPECT_EQ(result.pictures[3], decoder.scene().patterns[1].picture);
}

/// Some patterns in three slots, one after the other in packets of their own.
void write_patterns(Writer& w, int count) {
  for (int k = 0; k < count; ++k) w.pattern(face_picture(k + 1), 1 + k % 3, 1 + (3 * k + 1) % 9);
}

/// Plays a stream up to a byte, and then the rest, with the decoder's picture drawn again in between.
struct PlayedInTwo {
  Played result;
  std::size_t pictures = 0;  ///< of the first part
  Picture again;

  PlayedInTwo(const Writer& w, std::size_t middle) {
    StreamDecoder decoder;
    decoder.feed(std::span(w.bytes).first(middle));
    EXPECT_FALSE(play(decoder, result));
    pictures = result.pictures.size();
    EXPECT_TRUE(decoder.render(again));
    EXPECT_TRUE(decoder.render(again)) << "and once more";
    decoder.feed(std::span(w.bytes).subspan(middle));
    decoder.close();
    EXPECT_TRUE(play(decoder, result));
    EXPECT_TRUE(result.errors.empty());
  }
};

// Four of them wait for the next picture; before a fifth the picture is kept as it is.
TEST(StreamDecoderPatterns, PatternsThatArriveLeaveThePictureShownAsItIs) {
  for (const int count : {1, 4, 5, 9}) {
    Writer w = begun(4), at_once = begun(4);
    w.motion(0, 10, true).blend(3);
    write_patterns(w, count);
    const std::size_t arrived = w.bytes.size();
    w.blend(7);
    const PlayedInTwo played_in_two(w, arrived);
    ASSERT_EQ(played_in_two.pictures, 3U);
    EXPECT_EQ(played_in_two.again, played_in_two.result.pictures[2]) << count;
    // The same store at the next picture.
    at_once.motion(0, 10, true);
    write_patterns(at_once, count);
    const std::vector<Picture> expected = played(at_once.blend(3).blend(7).bytes).pictures;
    ASSERT_EQ(played_in_two.result.pictures.size(), 10U);
    for (std::size_t t = 3; t < 10; ++t)
      EXPECT_EQ(played_in_two.result.pictures[t], expected[t]) << count << ": " << t;
    EXPECT_NE(played_in_two.result.pictures[2], expected[2]) << "had they not waited";
  }
}

TEST(StreamDecoderPatterns, PatternsOfOnePacketLeaveThePictureShownAsItIs) {
  Writer w = begun(4);
  w.motion(0, 10, true).blend(3);
  std::vector<PatternSyntax> patterns;
  for (int k = 0; k < 6; ++k) patterns.push_back({1 + k % 3, k, {}, w.frame(face_picture(k + 1))});
  patterns[0].picture = 6;
  w.patterns(patterns);
  const std::size_t arrived = w.bytes.size();
  const PlayedInTwo played_in_two(w.blend(7), arrived);
  ASSERT_EQ(played_in_two.pictures, 3U);
  EXPECT_EQ(played_in_two.again, played_in_two.result.pictures[2]);
}

// Twice a new slot and twice the first one, before the next picture.
TEST(StreamDecoderPatterns, OfSeveralPatternsInASlotTheLastOneStays) {
  for (const int slot : {0, 1}) {
    Writer w = begun(2);
    w.motion(0, 10, true).blend(3);
    w.pattern(face_picture(1), slot, 4).pattern(face_picture(5), slot, 5);
    const std::size_t arrived = w.bytes.size();
    w.blend(7);
    const PlayedInTwo played_in_two(w, arrived);
    EXPECT_EQ(played_in_two.again, played_in_two.result.pictures[2]);
    StreamDecoder decoder;
    Played result;
    play_through(decoder, w, result);
    ASSERT_EQ(decoder.scene().patterns.size(), slot + 1U);
    EXPECT_EQ(decoder.scene().patterns[static_cast<std::size_t>(slot)].seen.picture, 5);
    // The second frame alone: both are decoded, as in a stream that fills another slot first.
    Writer other = begun(3);
    other.motion(0, 10, true).pattern(face_picture(1), 1, 4).pattern(face_picture(5), 2, 5).blend(10);
    StreamDecoder both;
    Played unused;
    play_through(both, other, unused);
    EXPECT_EQ(decoder.scene().patterns[static_cast<std::size_t>(slot)].picture,
              both.scene().patterns[2].picture);
  }
}

TEST(StreamDecoderPatterns, ASurroundAfterPatternsLeavesThePictureShownAsItIs) {
  for (const int count : {1, 4, 5}) {
    const auto write = [&](Writer& w) {
      write_patterns(w, count);
      w.surround(4);
      write_patterns(w, 1);
    };
    Writer w = begun(4), at_once = begun(4);
    write(w.motion(0, 10, true).blend(3));
    const std::size_t arrived = w.bytes.size();
    const PlayedInTwo played_in_two(w.blend(7), arrived);
    ASSERT_EQ(played_in_two.pictures, 3U);
    EXPECT_EQ(played_in_two.again, played_in_two.result.pictures[2]) << count;
    write(at_once.motion(0, 10, true));
    const std::vector<Picture> expected = played(at_once.blend(3).blend(7).bytes).pictures;
    ASSERT_EQ(played_in_two.result.pictures.size(), 10U);
    for (std::size_t t = 3; t < 10; ++t)
      EXPECT_EQ(played_in_two.result.pictures[t], expected[t]) << count << ": " << t;
  }
}

// Waiting patterns belong to a scene that is no longer shown.
TEST(StreamDecoderPatterns, ANewSceneLeavesThePictureShownAsItIs) {
  for (const int count : {0, 1, 4, 5}) {
    Writer w = begun(4);
    w.motion(0, 3, true).blend(3);
    for (int k = 0; k < count; ++k) w.pattern(face_picture(k + 1), 1 + k % 3, k % 2 + 1);
    fbs::Setup next = setup_of(3);
    next.before = {3, 9000};
    w.setup(next).geometry().surround().pattern();
    const std::size_t arrived = w.bytes.size();
    const PlayedInTwo played_in_two(w.motion(0, 5, true).blend(5), arrived);
    ASSERT_EQ(played_in_two.pictures, 3U);
    EXPECT_EQ(played_in_two.again, played_in_two.result.pictures[2]) << count;
    const Played whole = played(sample().bytes);
    ASSERT_EQ(played_in_two.result.pictures.size(), 8U);
    EXPECT_TRUE(std::equal(whole.pictures.begin(), whole.pictures.begin() + 5,
                           played_in_two.result.pictures.begin() + 3));
  }
}

// The rest state stays the first pattern's.
TEST(StreamDecoderPatterns, FirstPatternMayBeReplaced) {
  Writer w = begun(2);
  w.motion(0, 10, true).pattern(face_picture(1), 0, 9).blend(10, BlendMode::kStillAfter);
  StreamDecoder decoder;
  Played result;
  play_through(decoder, w, result);
  ASSERT_EQ(decoder.scene().patterns.size(), 1U);
  for (const Picture& p : result.pictures) EXPECT_EQ(p, decoder.scene().patterns[0].picture);
}

TEST(StreamDecoderPatterns, StoreOfOneIsReplacedWithoutBlends) {
  Writer w = begun(1);
  w.motion(0, 5, true).pattern(face_picture(3), 0, 4).motion(5, 10);
  const Played result = played(w.bytes), whole = played(sample().bytes);
  EXPECT_TRUE(result.errors.empty());
  ASSERT_EQ(result.pictures.size(), 10U);
  EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.begin() + 5, whole.pictures.begin()));
  for (std::size_t t = 5; t < 10; ++t) EXPECT_NE(result.pictures[t], whole.pictures[t]);
}

TEST(StreamDecoderPatterns, CountsBlendsAsMotionAndInTheStartup) {
  Writer w = begun();
  w.motion(0, 10, true).blend(5).pattern(face_picture(1), 1, 7).blend(5).end(10);
  const auto& b = w.begins;
  const ByteCount bytes = played(w.bytes).bytes;
  EXPECT_EQ(sum_of(bytes), w.bytes.size());
  EXPECT_EQ(bytes.motion, b[6] - b[4] + b[8] - b[7]);
  EXPECT_EQ(bytes.patterns, b[4] - b[3] + b[7] - b[6]);
  EXPECT_EQ(bytes.startup, b[6]) << "up to the first blend packet";
}

TEST(StreamDecoderPatterns, OrderIsChecked) {
  const std::vector<ErrorCode> invalid = {ErrorCode::kInvalidStream};
  const auto errors = [](auto&& write, int patterns = 3) {
    Writer w = begun(patterns);
    w.motion(0, 10, true);
    write(w);
    return errors_of(w);
  };
  const std::vector<ErrorCode> none;
  EXPECT_EQ(errors([](Writer& w) {
              w.told_pictures = 1000;
              w.patterns({{1, 400, {}, w.frame(face_picture(1)), true}});
            }),
            invalid)
      << "of a picture without motion";
  EXPECT_EQ(errors([](Writer& w) {
              w.told_pictures = 1000;
              w.pattern(face_picture(1), 1, 5);
            }),
            invalid)
      << "in a chain with more pictures: some are missing";
  EXPECT_EQ(errors([](Writer& w) { w.pattern(face_picture(1), 2, 5); }), none) << "slot 1 is still empty";
  EXPECT_EQ(errors([](Writer& w) { w.pattern(face_picture(1)); }), invalid) << "the first pattern once more";
  EXPECT_EQ(errors([](Writer& w) { w.blend(11); }), none) << "ahead of the motion";
  EXPECT_EQ(errors([](Writer& w) {
              for (int n = 0; n <= kMaxWaitingPictures; n += kMaxGroupPictures) w.blend(kMaxGroupPictures);
            }),
            std::vector{ErrorCode::kTooLarge})
      << "too far ahead";
  EXPECT_EQ(errors([](Writer& w) { w.blend(5); }, 1), invalid) << "nothing is blended";
  EXPECT_EQ(errors([](Writer& w) { w.blend(5).pattern(face_picture(1), 1, 2).blend(5); }), none);
  Writer early;
  early.setup(setup_of(3)).blend(1);
  EXPECT_EQ(errors_of(early), invalid) << "before the first pattern";
}

TEST(StreamDecoderPatterns, SlotBeyondTheStoreIsTooLarge) {
  Writer w = begun(3);
  w.motion(0, 10, true);
  w.pattern(face_picture(1), 3, 5);
  EXPECT_EQ(errors_of(w), std::vector<ErrorCode>{ErrorCode::kTooLarge});
}

TEST(StreamDecoderPatterns, BlendsBeginWithAKeyGroup) {
  RangeEncoder not_key;
  not_key.raw_bit(kNotKey, false);
  code_first(not_key, 0, 0);
  EXPECT_EQ(errors_of(begun().motion(0, 10, true).packet(PacketType::kBlend, not_key.finish())),
            std::vector<ErrorCode>{ErrorCode::kInvalidStream});
  BlendEncoder encoder;
  ASSERT_TRUE(encoder.encode({true, 0, 0, std::vector<RegionModes>(5)}));
  Writer lost = begun();
  lost.motion(0, 10, true)
      .packet(PacketType::kBlend, encoder.encode({false, 5, 0, std::vector<RegionModes>(5)}));
  const Played result = played(lost.bytes);
  EXPECT_EQ(result.errors.size(), 1U) << "the key group has been lost";
  EXPECT_TRUE(result.pictures.empty());
}

TEST(StreamDecoderPatterns, OnlyRecentPicturesMayHaveAPattern) {
  for (const bool kept : {true, false}) {
    Writer w = begun();
    for (int t = 0; t < 300; t += 100) w.motion(t, t + 100, t == 0);
    w.blend(256, BlendMode::kStillBefore).blend(kept ? 3 : 4, BlendMode::kStillBefore);
    w.pattern(face_picture(1), 1, 259 - kKeptPictures).blend(10, BlendMode::kStillBefore);
    EXPECT_EQ(errors_of(w).empty(), kept);
  }
}

TEST(StreamDecoderPatterns, TooManyPicturesThatWaitAreAnError) {
  Writer w = begun();
  for (int t = 0; t <= kMaxWaitingPictures; t += 256) w.motion(t, t + 256, t == 0);
  EXPECT_EQ(errors_of(w), std::vector<ErrorCode>{ErrorCode::kTooLarge});
}

TEST(StreamDecoderPatterns, SceneWithoutGeometryCrossFades) {
  Writer w;
  w.setup(setup_of(2))
      .pattern()
      .motion(0, 5, true)
      .pattern(face_picture(4), 1, 4)
      .blend(5, BlendMode::kByTime);
  StreamDecoder decoder;
  Played result;
  play_through(decoder, w, result);
  ASSERT_EQ(result.pictures.size(), 5U);
  const Picture &first = decoder.scene().patterns[0].picture, &last = decoder.scene().patterns[1].picture;
  EXPECT_EQ(result.pictures[0], first);
  EXPECT_EQ(result.pictures[4], last);
  for (std::size_t i = 0; i < first.y.samples.size(); ++i)
    ASSERT_EQ(result.pictures[2].y.samples[i], (first.y.samples[i] + last.y.samples[i] + 1) / 2);
}

TEST(StreamDecoderPatterns, StreamMayBeCutAnywhere) {
  Writer w = begun();
  w.motion(0, 10, true).blend(5).pattern(face_picture(1), 1, 7).motion(10, 15).blend(10);
  const Played whole = played(w.bytes);
  ASSERT_EQ(whole.pictures.size(), 15U);
  for (std::size_t size = w.begins[3]; size < w.bytes.size(); size += 11) {
    const Played result = played(std::span(w.bytes).first(size));
    ASSERT_LE(result.errors.size(), 1U) << size;
    ASSERT_EQ(result.pictures.size(), w.begins[6] <= size ? 5U : 0U) << size;
    EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), whole.pictures.begin())) << size;
  }
}

}  // namespace
}  // namespace fbs
