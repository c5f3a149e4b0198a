// Streams of several scenes, joined in the middle or with pictures missing. SPEC 6.1, 6.2.
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "decoder/stream/stream_decoder.h"
#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs {
namespace {

/// Three scenes of five pictures; the second has durations of its own. Five packets each.
const Writer& three_scenes() {
  static const Writer w = [] {
    Writer s;
    s.scene({}, 5).scene({5, 15000}, 5, {9000, 1, 1, 1, 1}).scene({10, 24004}, 5).end(15);
    return s;
  }();
  return w;
}

/// The bytes without packets `begin`..`end` - 1.
Bytes without(const Writer& w, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t packet) {
    return w.bytes.begin() + static_cast<std::ptrdiff_t>(w.begins[packet]);
  };
  Bytes out(w.bytes.begin(), at(begin));
  out.insert(out.end(), at(end), w.bytes.end());
  return out;
}

void expect_part(const Played& part, const Played& whole, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    EXPECT_EQ(part.pictures[i], whole.pictures[i]) << i;
    EXPECT_EQ(part.positions[i], whole.positions[i]) << i;
    EXPECT_EQ(part.durations[i], whole.durations[i]) << i;
    EXPECT_FALSE(part.held[i]) << i;
  }
}

TEST(StreamDecoderScenes, PicturesHaveNumbersAndTimes) {
  const Played whole = played(three_scenes().bytes);
  EXPECT_TRUE(whole.errors.empty());
  ASSERT_EQ(whole.positions.size(), 15U);
  StreamPosition expected;
  for (std::size_t i = 0; i < 15; ++i) {
    EXPECT_EQ(whole.positions[i], expected) << i;
    ++expected.pictures;
    expected.time += whole.durations[i];
  }
}

TEST(StreamDecoderScenes, MayBeJoinedAtAnyOfThem) {
  const Played whole = played(three_scenes().bytes), joined = played(without(three_scenes(), 0, 5));
  EXPECT_TRUE(joined.errors.empty());
  ASSERT_EQ(joined.pictures.size(), 10U);
  EXPECT_EQ(joined.positions, std::vector(whole.positions.begin() + 5, whole.positions.end()));
  EXPECT_EQ(joined.pictures, std::vector(whole.pictures.begin() + 5, whole.pictures.end()));
}

TEST(StreamDecoderScenes, LostSceneIsHeld) {
  StreamDecoder decoder;
  decoder.feed(without(three_scenes(), 5, 10));
  decoder.close();
  Played result;
  ASSERT_TRUE(play(decoder, result));
  const Played whole = played(three_scenes().bytes);
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  EXPECT_EQ(result.errors[0].text, "5 pictures are missing");
  EXPECT_EQ(result.errors[0].byte_offset, three_scenes().begins[5]);
  ASSERT_EQ(result.pictures.size(), 15U);
  expect_part(result, whole, 0, 5);
  expect_part(result, whole, 10, 15);
  for (std::size_t i = 5; i < 10; ++i) {
    EXPECT_TRUE(result.held[i]);
    EXPECT_EQ(result.pictures[i], result.pictures[4]);
  }
  EXPECT_EQ(std::vector(result.durations.begin() + 5, result.durations.begin() + 10),
            (std::vector<std::uint32_t>{3000, 3000, 3000, 3, 1}));
  EXPECT_EQ(decoder.held_pictures(), 5U);
  EXPECT_EQ(decoder.missing_pictures(), 5U);
  EXPECT_EQ(decoder.pictures(), 15U);
}

// The pattern is the largest packet, and so the likeliest to be hit: its scene has no picture to be held.
TEST(StreamDecoderScenes, PictureOfAnEarlierSceneIsHeldWhereASceneHasNone) {
  const Writer& w = three_scenes();
  Bytes bytes = w.bytes;
  bytes[w.begins[8] + 20] ^= 3;
  StreamDecoder decoder;
  decoder.feed(bytes);
  decoder.close();
  const Played whole = played(w.bytes);
  Picture picture;
  for (std::size_t i = 0, errors = 0; i < 15;) {
    const auto status = decoder.next();
    if (!status) {
      ASSERT_EQ(++errors, 1U);
      continue;
    }
    ASSERT_TRUE(decoder.render(picture));
    EXPECT_EQ(decoder.held(), i >= 5 && i < 10) << i;
    EXPECT_EQ(picture, whole.pictures[i >= 5 && i < 10 ? 4 : i]) << i;
    EXPECT_EQ(decoder.scene().setup.before.pictures, i < 10 ? 0U : 10U) << "the scene is that of the picture";
    ++i;
  }
  EXPECT_EQ(*decoder.next(), DecodeStatus::kEnd);
}

TEST(StreamDecoderScenes, LostSetupCostsItsSceneOnly) {
  const Writer& w = three_scenes();
  Bytes bytes = w.bytes;
  bytes[w.begins[5] + 4] ^= 3;
  const Played result = played(bytes), whole = played(w.bytes);
  EXPECT_EQ(result.errors.size(), 1U);
  ASSERT_EQ(result.pictures.size(), 15U);
  expect_part(result, whole, 10, 15);
}

TEST(StreamDecoderScenes, HoldsUpToTheNumberOfTheEndPacket) {
  Writer w;
  w.scene({}, 5, {1000, 1000, 1000, 1000, 1000}).end(8);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_EQ(result.errors[0].text, "3 pictures are missing");
  ASSERT_EQ(result.pictures.size(), 8U);
  EXPECT_EQ(result.durations[7], 3000U);
  EXPECT_EQ(result.positions[7], (StreamPosition{7, 11000}));
}

TEST(StreamDecoderScenes, FewerPicturesThanShownAreInvalid) {
  Writer w;
  w.scene({}, 5).scene({4, 12000}, 5).scene({10, 30000}, 2).end(11);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 2U);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  EXPECT_EQ(result.errors[0].byte_offset, w.begins[5]);
  EXPECT_EQ(result.errors[1].code, ErrorCode::kInvalidStream) << "eleven, and twelve have been shown";
  ASSERT_EQ(result.pictures.size(), 12U) << "the second scene is lost";
  for (std::size_t i = 5; i < 10; ++i) EXPECT_TRUE(result.held[i]) << i;
}

TEST(StreamDecoderScenes, NoMoreThanTheLimitIsHeld) {
  Writer w;
  w.scene({}, 1);
  const std::uint64_t many = kMaxHeldPictures + 2;
  for (int i = 0; i < 3; ++i) w.setup(setup_at({many, many * 3000}));
  w.scene({many, many * 3000}, 2).end(kMaxStreamPictures);
  StreamDecoder decoder;
  decoder.feed(w.bytes);
  decoder.close();
  Played result;
  ASSERT_TRUE(play(decoder, result));
  ASSERT_EQ(result.errors.size(), 2U);
  for (const Error& error : result.errors) EXPECT_EQ(error.code, ErrorCode::kTooLarge);
  ASSERT_EQ(result.pictures.size(), 3U);
  EXPECT_EQ(result.positions[1], (StreamPosition{many, many * 3000})) << "as if joined there";
  EXPECT_EQ(decoder.held_pictures(), 0U);
  EXPECT_EQ(decoder.missing_pictures(), kMaxStreamPictures - 3);
}

TEST(StreamDecoderScenes, RefusedSetupIsALoss) {
  Writer w;
  w.scene({}, 5);
  fbs::Setup other = setup_at({5, 15000});
  other.format.width += 2;
  w.packet(PacketType::kSetup, encode_setup(other)).motion(5, 10, true);
  w.scene({10, 30000}, 5).end(15);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kUnsupported);
  ASSERT_EQ(result.pictures.size(), 15U);
  EXPECT_EQ(result.pictures[9], result.pictures[4]);
}

TEST(StreamDecoderScenes, HeldPicturesComeAsSoonAsTheSetupTells) {
  const Bytes bytes = without(three_scenes(), 5, 10);
  const auto& b = three_scenes().begins;
  StreamDecoder decoder;
  decoder.feed(std::span(bytes).first(b[5] + b[11] - b[10]));
  Played result;
  EXPECT_FALSE(play(decoder, result));
  EXPECT_EQ(result.pictures.size(), 10U);
  EXPECT_TRUE(result.held.back());
}

// SPEC 6.6

/// A scene that keeps others, of three patterns.
fbs::Setup later_setup(const StreamPosition& before, SceneKeeping keeps = SceneKeeping::kAndPresent) {
  fbs::Setup setup = setup_of(3);
  setup.before = before;
  setup.keeps = keeps;
  return setup;
}

StreamPosition after(std::uint64_t pictures) {
  return {pictures, pictures * 3000};
}

/// Two scenes that take turns, five pictures each; the head of either is four packets. Ten pictures have a
/// state when five are shown.
/// @param turns  0: the first scene, 1: the second
Writer turns_of(const std::vector<std::size_t>& turns) {
  Writer w;
  std::vector<int> shown(2);
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const std::size_t scene = turns[k];
    const bool begins = shown[scene] == 0;
    if (begins)
      w.setup(later_setup(after(5 * k), k == 0 ? SceneKeeping::kNone : SceneKeeping::kAndPresent))
          .geometry()
          .surround()
          .pattern(face_picture(static_cast<int>(scene)));
    else
      w.go_back(scene, after(5 * k), true, static_cast<std::uint32_t>(shown[scene]));
    if (begins) w.motion(0, 5, true);
    w.motion(shown[scene] + 5, shown[scene] + 10);
    if (!begins) w.pattern(face_picture(static_cast<int>(scene) + 2), 1, shown[scene] + 2);
    w.blend(5, {}, true);
    shown[scene] += 5;
  }
  w.end(5 * turns.size());
  return w;
}

/// The same pictures, each scene by itself.
std::vector<Picture> pictures_of(const std::vector<std::size_t>& turns) {
  const auto of = [&](std::size_t scene) {
    Writer w;
    w.setup(later_setup({})).geometry().surround().pattern(face_picture(static_cast<int>(scene)));
    w.motion(0, 5, true);
    for (int shown = 0, k = 0; k < std::count(turns.begin(), turns.end(), scene); ++k, shown += 5) {
      w.motion(shown + 5, shown + 10);
      if (k > 0) w.pattern(face_picture(static_cast<int>(scene) + 2), 1, shown + 2);
      w.blend(5, {}, true);
    }
    return played(w.bytes).pictures;
  };
  std::vector<std::vector<Picture>> alone{of(0), of(1)};
  std::vector<Picture> out;
  for (const std::size_t scene : turns) {
    out.insert(out.end(), alone[scene].begin(), alone[scene].begin() + 5);
    alone[scene].erase(alone[scene].begin(), alone[scene].begin() + 5);
  }
  return out;
}

const std::vector<std::size_t> kTurns = {0, 1, 0, 1, 0};

TEST(StreamDecoderScenes, ReturnGoesOnWhereTheSceneWasLeft) {
  const Writer w = turns_of(kTurns);
  const auto expected = pictures_of(kTurns);
  for (const int threads : {1, 3}) {
    StreamDecoder decoder;
    decoder.use_threads(threads);
    Played result;
    play_through(decoder, w, result);
    ASSERT_EQ(result.pictures.size(), 25U);
    EXPECT_EQ(result.pictures, expected);
    for (std::size_t i = 0; i < 25; ++i) EXPECT_EQ(result.positions[i], after(i)) << i;
  }
}

/// Its packets begin[]: 0..6 the first scene, 7..13 the second, then four in each turn.
void expect_held(const Bytes& bytes, std::size_t errors, const std::vector<std::size_t>& held) {
  const Played result = played(bytes);
  const auto expected = pictures_of(kTurns);
  EXPECT_EQ(result.errors.size(), errors);
  ASSERT_EQ(result.pictures.size(), 25U);
  for (std::size_t i = 0; i < 25; ++i) {
    const bool is_held = std::count(held.begin(), held.end(), i / 5) > 0;
    EXPECT_EQ(result.held[i], is_held) << i;
    if (!is_held) {
      EXPECT_EQ(result.pictures[i], expected[i]) << i;
    }
    EXPECT_EQ(result.positions[i], after(i)) << i;
  }
}

TEST(StreamDecoderScenes, WithoutItsReturnASceneIsDamagedUpToTheNext) {
  const Writer w = turns_of(kTurns);
  expect_held(without(w, 14, 15), 1, {2, 4});
}

TEST(StreamDecoderScenes, WhatBelongsToALostTurnIsHeldBeforeTheNext) {
  const Writer w = turns_of(kTurns);
  expect_held(without(w, 18, 22), 1, {3});
}

TEST(StreamDecoderScenes, PicturesThatWereHeldAreNotShownAfterAReturn) {
  const Writer w = turns_of(kTurns);
  expect_held(without(w, 17, 18), 2, {2});
}

TEST(StreamDecoderScenes, ReturnToASceneThatIsLostIsOneErrorWithIt) {
  const Writer w = turns_of(kTurns);
  Bytes bytes = w.bytes;
  bytes[w.begins[10] + 30] ^= 3;  // the first pattern of the second scene
  expect_held(bytes, 1, {1, 3});
}

TEST(StreamDecoderScenes, JoinableSceneHasNoReturnToOneBefore) {
  Writer w;
  w.scene({}, 5).scene(after(5), 5).go_back(0, after(10)).motion(5, 10).end(15);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_EQ(result.errors[0].text, "a return to a scene that is not known");
  EXPECT_EQ(result.errors[0].byte_offset, w.begins[10]);
  ASSERT_EQ(result.pictures.size(), 15U);
  for (std::size_t i = 10; i < 15; ++i) EXPECT_TRUE(result.held[i]) << i;
}

TEST(StreamDecoderScenes, MayBeJoinedBetweenReturns) {
  Writer w;
  w.scene({}, 5).setup(later_setup(after(5))).pattern().motion(0, 5, true).blend(5);
  w.go_back(0, after(10)).motion(5, 10);
  const std::size_t joinable = w.begins.size();
  w.scene(after(15), 5).setup(later_setup(after(20))).pattern(face_picture(1)).motion(0, 5, true).blend(5);
  w.go_back(2, after(25)).motion(5, 10).go_back(3, after(30)).motion(5, 10).blend(5).end(35);
  const Played whole = played(w.bytes), joined = played(without(w, 0, joinable));
  EXPECT_TRUE(whole.errors.empty());
  EXPECT_TRUE(joined.errors.empty());
  ASSERT_EQ(whole.pictures.size(), 35U);
  EXPECT_EQ(joined.pictures, std::vector(whole.pictures.begin() + 15, whole.pictures.end()));
  EXPECT_EQ(joined.positions, std::vector(whole.positions.begin() + 15, whole.positions.end()));
}

TEST(StreamDecoderScenes, CountsAndRecordsGoOnWithAReturn) {
  const Writer w = turns_of({0, 1, 0});
  StreamDecoder decoder;
  decoder.count_motion_bits();
  decoder.record_patterns();
  Played result;
  play_through(decoder, w, result);
  std::vector<std::uint64_t> pictures;
  for (const PatternRecord& record : decoder.pattern_records()) pictures.push_back(record.picture);
  EXPECT_EQ(pictures, (std::vector<std::uint64_t>{0, 5, 12}));
  const auto bits = decoder.motion_bits();
  EXPECT_LT(std::accumulate(bits.begin(), bits.end(), std::uint64_t{0}) / 256 / 8, decoder.bytes().motion);
}

}  // namespace
}  // namespace fbs
