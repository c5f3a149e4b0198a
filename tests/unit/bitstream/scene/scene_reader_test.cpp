#include "bitstream/scene/scene_reader.h"

#include <gtest/gtest.h>

#include <vector>

#include "bitstream/payload/sound_payload.h"
#include "tests/unit/bitstream/scene/scene_sender.h"

namespace fbs {
namespace {

using namespace scene_sender;  // NOLINT(google-build-using-namespace): a test's own tools

TEST(SceneReader, MotionReleasesPicturesOfASinglePattern) {
  Sender s = begun(1, 5);
  EXPECT_EQ(shown(s.reader), numbers(0, 5));
}

TEST(SceneReader, BlendsReleasePicturesOfSeveral) {
  Sender s = begun(4, 5);
  EXPECT_TRUE(shown(s.reader).empty());
  ASSERT_TRUE(s.blend(3));
  EXPECT_EQ(shown(s.reader), numbers(0, 3));
  ASSERT_TRUE(s.blend(3));
  EXPECT_EQ(shown(s.reader), numbers(3, 5)) << "the last is ahead of the motion";
  ASSERT_TRUE(s.motion(5));
  EXPECT_EQ(shown(s.reader), numbers(5, 6));
}

TEST(SceneReader, GivesEachPatternTheStateOfItsPicture) {
  Sender s = begun(4, 5);
  const auto read = s.pattern(1, 3);
  ASSERT_TRUE(read);
  const auto& patterns = std::get<std::vector<ScenePattern>>(*read);
  ASSERT_EQ(patterns.size(), 1u);
  EXPECT_FALSE(patterns.front().is_first());
  EXPECT_EQ(patterns.front().seen.picture, 3);
  EXPECT_EQ(patterns.front().seen.pose[kYaw], 3);
}

TEST(SceneReader, TheFirstPatternComesOnce) {
  Sender s = begun(4, 5);
  EXPECT_EQ(s.pattern(0, 0).error().text, "a pattern out of order");
}

TEST(SceneReader, SlotsMayBeFilledInAnyOrder) {
  Sender s = begun(4, 5);
  EXPECT_EQ(seen_in(s.pattern(2, 1)), std::vector{1});
  EXPECT_EQ(seen_in(s.pattern(1, 4, true)), std::vector{4});
}

TEST(SceneReader, ErrorsHaveTheOffsetAndLoseASceneWithoutAHead) {
  Sender s;
  ASSERT_TRUE(s.begin());
  const auto early = s.motion(5);
  EXPECT_EQ(early.error().text, "motion before the first pattern");
  EXPECT_EQ(early.error().byte_offset, 77u);
  EXPECT_TRUE(s.reader.lost());
  EXPECT_TRUE(skipped(s.pattern(0, 0)));
  ASSERT_TRUE(s.begin());
  EXPECT_FALSE(s.reader.lost());
  EXPECT_FALSE(s.reader.has_losses());
}

// SPEC 6.2
TEST(SceneReader, ALossInTheHeadLosesTheScene) {
  for (const bool has_head : {false, true}) {
    Sender s(4);
    ASSERT_TRUE(s.begin());
    if (has_head) {
      ASSERT_TRUE(s.pattern(0, 0));
    }
    s.reader.lose();
    EXPECT_TRUE(s.reader.has_losses());
    EXPECT_EQ(s.reader.lost(), !has_head);
    EXPECT_EQ(skipped(s.motion(5)), !has_head);
    EXPECT_EQ(skipped(s.blend(5)), !has_head);
    EXPECT_EQ(shown(s.reader), numbers(0, has_head ? 5 : 0));
    s.reader.lose_scene();
    EXPECT_TRUE(skipped(s.motion(5)));
    ASSERT_TRUE(s.begin());
    EXPECT_FALSE(s.reader.lost() || s.reader.has_losses());
  }
}

TEST(SceneReader, LostMotionIsBridgedByTheNextKeyGroup) {
  Sender s = begun(1, 5);
  s.loses = true;
  ASSERT_TRUE(s.motion(5));
  s.loses = false;
  EXPECT_FALSE(s.motion(5)) << "the loss is noticed";
  EXPECT_EQ(shown(s.reader), numbers(0, 5));
  const auto key = s.motion(5, true);
  ASSERT_TRUE(key);
  EXPECT_EQ(std::get<MotionGroup>(*key).missing, 10);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(s.reader.pictures().find(i)->guessed, i >= 5 && i < 15) << i;
  EXPECT_EQ(shown(s.reader), numbers(5, 20)) << "a steady motion goes on";
  ASSERT_TRUE(s.motion(5));
  EXPECT_EQ(shown(s.reader), numbers(20, 25));
  EXPECT_FALSE(s.reader.lost());
}

TEST(SceneReader, AnErrorInMotionCostsWhatFollowsUpToTheNextKeyGroup) {
  Sender s = begun(1, 5);
  s.excess = 20;
  EXPECT_FALSE(s.motion(5));
  s.excess = 0;
  EXPECT_TRUE(s.reader.has_losses());
  EXPECT_FALSE(s.reader.lost());
  EXPECT_TRUE(skipped(s.motion(5)));
  ASSERT_TRUE(s.motion(5, true));
  EXPECT_EQ(shown(s.reader), numbers(0, 20));
}

TEST(SceneReader, LostBlendsAreFilledWithTheLastModes) {
  for (const bool damaged : {false, true}) {
    Sender s = begun(4, 12);
    constexpr auto kBefore = BlendMode::kStillBefore, kAfter = BlendMode::kStillAfter;
    ASSERT_TRUE(s.blend(3, kBefore));
    s.excess = damaged ? 20 : 0;
    s.loses = !damaged;
    EXPECT_EQ(s.blend(2, kAfter).has_value(), !damaged);
    s.loses = false;
    s.excess = 0;
    const auto next = s.blend(2, kAfter);
    EXPECT_EQ(damaged ? skipped(next) : !next, true);
    EXPECT_EQ(shown(s.reader), numbers(0, 3));
    ASSERT_TRUE(s.blend(2, kAfter, true));
    std::vector<BlendMode> modes, expected(4, kBefore);
    EXPECT_EQ(shown(s.reader, &modes), numbers(3, 9));
    expected.insert(expected.end(), 2, kAfter);
    EXPECT_EQ(modes, expected);
    EXPECT_TRUE(s.reader.has_losses());
  }
}

TEST(SceneReader, ALostPatternCostsThoseOfItsChain) {
  for (const bool damaged : {false, true}) {
    Sender s = begun(3, 10);
    EXPECT_EQ(seen_in(s.pattern(1, 4)), std::vector{4});
    s.loses = !damaged;
    const auto lost = s.pattern(damaged ? 3 : 2, 5);
    s.loses = false;
    if (damaged) {
      EXPECT_EQ(lost.error().code, ErrorCode::kTooLarge);
    }
    const auto next = s.pattern(1, 6);
    EXPECT_EQ(damaged ? skipped(next) : !next, true);
    EXPECT_EQ(seen_in(s.pattern(2, 7, true)), std::vector{7});
    EXPECT_TRUE(skipped(s.pattern(1, 8))) << "the chain stays broken";
    ASSERT_TRUE(s.motion(5));
    ASSERT_TRUE(s.blend(15));
    EXPECT_EQ(shown(s.reader), numbers(0, 15));
    EXPECT_FALSE(s.reader.lost());
  }
}

TEST(SceneReader, PatternsThatCannotBeDecodedBreakTheirChain) {
  Sender s = begun(3, 10);
  s.reader.lose_patterns();
  EXPECT_TRUE(skipped(s.pattern(1, 4)));
  EXPECT_EQ(seen_in(s.pattern(2, 7, true)), std::vector{7});
}

TEST(SceneReader, OneThatIsAloneReplacesOlderPatternsOnly) {
  Sender s = begun(3, 10);
  ASSERT_TRUE(s.pattern(1, 4));
  for (const int picture : {3, 4}) EXPECT_TRUE(skipped(s.pattern(1, picture, true)));
  EXPECT_EQ(seen_in(s.pattern(2, 3, true)), std::vector{3}) << "another slot";
  EXPECT_EQ(seen_in(s.pattern(1, 6, true)), std::vector{6});
  EXPECT_TRUE(skipped(s.pattern(1, 6, true))) << "twice";
  EXPECT_TRUE(skipped(s.pattern(1, 5, true))) << "late";
  EXPECT_EQ(seen_in(s.pattern(1, 5)), std::vector{5}) << "the chain may go back";
  EXPECT_EQ(seen_in(s.pattern(0, 1, true)), std::vector{1}) << "in the place of the first";
}

TEST(SceneReader, APatternNeedsTheStateOfItsPicture) {
  for (const bool known : {false, true}) {  // that something is missing
    Sender s = begun(3, 5);
    s.loses = true;
    ASSERT_TRUE(s.motion(5));
    s.loses = false;
    if (known) s.reader.lose();
    const auto in_the_chain = s.pattern(1, 3);
    EXPECT_EQ(known ? skipped(in_the_chain) : !in_the_chain, true);
    EXPECT_EQ(seen_in(s.pattern(1, 3, true)), std::vector{3});
    EXPECT_TRUE(skipped(s.pattern(1, 7, true)));
    ASSERT_TRUE(s.motion(5, true));
    EXPECT_TRUE(skipped(s.pattern(1, 7, true))) << "a guess";
    EXPECT_EQ(seen_in(s.pattern(1, 12, true)), std::vector{12});
  }
}

TEST(SceneReader, HeadPacketsBehindTheHeadMayBeLost) {
  for (const PacketType type : {PacketType::kWireFrame, PacketType::kGeometry, PacketType::kSurround}) {
    Sender s = begun(1, 5);
    EXPECT_FALSE(s.read(type, Bytes(3, 0xFF))) << "damaged";
    EXPECT_TRUE(s.reader.has_losses());
    EXPECT_FALSE(s.reader.lost());
    ASSERT_TRUE(s.motion(5));
    EXPECT_EQ(shown(s.reader), numbers(0, 10));
  }
}

TEST(SceneReader, NothingOfASceneComesBeforeItsSetup) {
  Sender s;
  EXPECT_EQ(s.pattern(0, 0).error().text, "a packet before the setup");
}

TEST(SceneReader, SkipsTypesThatItDoesNotKnow) {
  Sender s;
  const auto read = s.read(static_cast<PacketType>(99), Bytes{1, 2});
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(*read));
}

TEST(SceneReader, WhatIsWrongWithSoundDoesNoHarmToPictures) {
  Sender s;
  ASSERT_TRUE(s.begin());
  ASSERT_TRUE(s.read(PacketType::kSoundSetup, encode_sound_setup({})));
  ASSERT_TRUE(s.read(PacketType::kSound, encode_sound({5, {{1}}}, {})));
  EXPECT_EQ(s.read(PacketType::kSound, encode_sound({5, {{1}}}, {})).error().text,
            "sound comes out of order");
  EXPECT_FALSE(s.reader.lost());
  ASSERT_TRUE(s.pattern(0, 0));
}

TEST(SceneReader, SoundKeepsItsOrderAcrossScenes) {
  Sender s;
  for (int scene = 0; scene < 2; ++scene) {
    ASSERT_TRUE(s.begin());
    EXPECT_FALSE(s.reader.sound_setup());
    ASSERT_TRUE(s.read(PacketType::kSoundSetup, encode_sound_setup({})));
    EXPECT_EQ(s.read(PacketType::kSound, encode_sound({5, {{1}}}, {})).has_value(), scene == 0);
  }
}

// The group is refused, but the next one is taken for it: pictures get states of others.
TEST(SceneReader, NumbersStayRightWhereAGroupIsRefused) {
  Sender s = begun(4, kMaxGroupPictures);
  for (int n = kMaxGroupPictures; n < kMaxWaitingPictures; n += kMaxGroupPictures)
    ASSERT_TRUE(s.motion(kMaxGroupPictures));
  EXPECT_EQ(s.motion(kMaxGroupPictures).error().code, ErrorCode::kTooLarge);
  ASSERT_TRUE(s.blend(kMaxGroupPictures));
  (void)shown(s.reader);
  ASSERT_TRUE(s.motion(kMaxGroupPictures));
  if (const auto* const picture = s.reader.pictures().find(kMaxWaitingPictures);
      picture && !picture->guessed) {
    EXPECT_EQ(picture->state.pose[kYaw], kMaxWaitingPictures % 1000);
  }
}

// Up to the first knots of a key group behind a gap, states depend on the anchor, which is not the encoder's.
TEST(SceneReader, PicturesBeforeTheFirstKnotBehindAGapAreGuesses) {
  Sender s = begun(3, 5);
  s.loses = true;
  ASSERT_TRUE(s.motion(5));
  s.loses = false;
  ASSERT_TRUE(s.motion(10, true, 10));
  for (int i = 10; i < 19; ++i) EXPECT_TRUE(s.reader.pictures().find(i)->guessed) << i;
  EXPECT_FALSE(s.reader.pictures().find(19)->guessed);
}

// So that a pattern of a guessed picture is skipped, as StreamDecoder does, and not an error.
TEST(SceneReader, AGapInTheMotionIsALoss) {
  Sender s = begun(3, 5);
  s.loses = true;
  ASSERT_TRUE(s.motion(5));
  s.loses = false;
  ASSERT_TRUE(s.motion(5, true));
  EXPECT_TRUE(s.reader.has_losses());
  EXPECT_TRUE(skipped(s.pattern(1, 7, true)));
}

// AV1 predicts the second from the first, which is left out.
TEST(SceneReader, APatternLeftOutCostsThoseBehindItInThePacket) {
  Sender s = begun(3, 5);
  s.loses = true;
  ASSERT_TRUE(s.motion(5));
  s.loses = false;
  s.reader.lose();
  ASSERT_TRUE(s.motion(5, true));
  EXPECT_EQ(seen_in(s.patterns({{1, 7, {}, {1, 2, 3}}, {2, 12, {}, {1, 2, 3}}})), std::vector<int>{});
}

// The same where nothing is known to be missing: the packet is refused, and the next goes on with its chain.
TEST(SceneReader, APatternThatIsRefusedBreaksItsChain) {
  Sender s = begun(3, 256);
  ASSERT_TRUE(s.motion(256));
  ASSERT_TRUE(s.blend(256));
  ASSERT_TRUE(s.blend(256));
  (void)shown(s.reader);
  EXPECT_EQ(s.pattern(1, 100).error().text, "a pattern of a picture without a state");
  EXPECT_TRUE(skipped(s.pattern(2, 400)));
}

// Six bits do not tell 64 pictures from none.
TEST(SceneReader, SixtyFourMissingPicturesBreakTheChain) {
  Sender s = begun(3, 64);
  s.loses = true;
  ASSERT_TRUE(s.motion(64));
  s.loses = false;
  EXPECT_FALSE(s.pattern(1, 30));
  EXPECT_TRUE(skipped(s.pattern(1, 100)));
}

}  // namespace
}  // namespace fbs
