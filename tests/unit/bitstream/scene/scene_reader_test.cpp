#include "bitstream/scene/scene_reader.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/track.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Payloads of one scene, read one by one. What stands for AV1 is not looked at.
class Sender {
 public:
  explicit Sender(int patterns = 1) {
    setup.format.frame_rate = {30, 1};
    setup.patterns = patterns;
    motion_.emplace(setup, CodedState{});
  }

  Result<SceneSyntax> read(PacketType type, const Result<Bytes>& payload) {
    EXPECT_TRUE(payload);
    payload_ = *payload;
    return reader.read({type, 77, payload_, packet_size(payload_.size())});
  }
  Result<SceneSyntax> begin() { return read(PacketType::kSetup, encode_setup(setup)); }
  Result<SceneSyntax> pattern(int slot, int picture) {
    const PatternSyntax pattern{slot, picture, {}, {1, 2, 3}};
    Setup wide = setup;
    wide.patterns = kMaxPatterns;
    return read(PacketType::kPattern, patterns_.encode(std::span(&pattern, 1), wide, pictures_));
  }
  Result<SceneSyntax> motion(std::size_t pictures) {
    const bool key = motion_->needs_key();
    MotionGroup group =
        knots_everywhere(motion_->anchor(key), std::vector<CodedState>(pictures), setup.parts);
    group.key = key;
    pictures_ += static_cast<std::int32_t>(pictures);
    return read(PacketType::kMotion, motion_->encode(group));
  }
  Result<SceneSyntax> blend(std::size_t pictures) {
    return read(PacketType::kBlend, blend_.encode({blend_.needs_key(), std::vector<RegionModes>(pictures)}));
  }

  Setup setup = toy_setup(96, 80);
  SceneReader reader;

 private:
  Bytes payload_;
  std::int32_t pictures_ = 0;  // that have a state
  std::optional<MotionEncoder> motion_;
  PatternPacketWriter patterns_;
  BlendEncoder blend_;
};

std::size_t released(SceneReader& reader) {
  std::size_t count = 0;
  for (; reader.pictures().has_next(); ++count) (void)reader.pictures().next();
  return count;
}

TEST(SceneReader, MotionReleasesPicturesOfASinglePattern) {
  Sender s;
  ASSERT_TRUE(s.begin());
  ASSERT_TRUE(s.pattern(0, 0));
  ASSERT_TRUE(s.motion(5));
  EXPECT_EQ(released(s.reader), 5u);
}

TEST(SceneReader, BlendsReleasePicturesOfSeveral) {
  Sender s(4);
  ASSERT_TRUE(s.begin());
  ASSERT_TRUE(s.pattern(0, 0));
  ASSERT_TRUE(s.motion(5));
  EXPECT_EQ(released(s.reader), 0u);
  ASSERT_TRUE(s.blend(3));
  EXPECT_EQ(released(s.reader), 3u);
  EXPECT_FALSE(s.blend(3));
}

TEST(SceneReader, GivesEachPatternTheStateOfItsPicture) {
  Sender s(4);
  ASSERT_TRUE(s.begin());
  ASSERT_TRUE(s.pattern(0, 0));
  ASSERT_TRUE(s.motion(5));
  const auto read = s.pattern(1, 3);
  ASSERT_TRUE(read);
  const auto& patterns = std::get<std::vector<ScenePattern>>(*read);
  ASSERT_EQ(patterns.size(), 1u);
  EXPECT_FALSE(patterns.front().is_first());
  EXPECT_EQ(patterns.front().seen.picture, 3);
}

TEST(SceneReader, PatternsStandInOrder) {
  Sender gap(4);
  ASSERT_TRUE(gap.begin());
  ASSERT_TRUE(gap.pattern(0, 0));
  ASSERT_TRUE(gap.motion(5));
  EXPECT_EQ(gap.pattern(2, 1).error().text, "a pattern out of order");
}

TEST(SceneReader, ErrorsHaveTheOffsetAndLoseTheScene) {
  Sender s;
  ASSERT_TRUE(s.begin());
  const auto early = s.motion(5);
  EXPECT_EQ(early.error().text, "motion before the first pattern");
  EXPECT_EQ(early.error().byte_offset, 77u);
  EXPECT_TRUE(s.reader.lost());
  const auto ignored = s.pattern(0, 0);
  ASSERT_TRUE(ignored);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(*ignored));
  ASSERT_TRUE(s.begin());
  EXPECT_FALSE(s.reader.lost());
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

}  // namespace
}  // namespace fbs
