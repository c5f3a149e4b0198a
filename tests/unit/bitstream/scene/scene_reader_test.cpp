#include "bitstream/scene/scene_reader.h"

#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <vector>

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/track.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The number of a picture, as its yaw.
CodedState coded_at(int picture) {
  CodedState state{};
  state[kYaw] = picture % 1000;
  return state;
}

/// Payloads of one scene, read one by one. What stands for AV1 is not looked at.
class Sender {
 public:
  explicit Sender(int patterns = 1) {
    setup.format.frame_rate = {30, 1};
    setup.patterns = patterns;
    motion_.emplace(setup, CodedState{});
  }

  Result<SceneSyntax> read(PacketType type, const Result<Bytes>& payload) {
    EXPECT_TRUE(payload) << payload.error().text;
    if (loses) return SceneSyntax{};
    payload_ = *payload;
    payload_.insert(payload_.end(), excess, 0x55);
    return reader.read({type, 77, payload_, packet_size(payload_.size()), false, check});
  }
  Result<SceneSyntax> begin() { return read(PacketType::kSetup, encode_setup(setup)); }
  Result<SceneSyntax> pattern(int slot, int picture, bool alone = false) {
    return patterns({{slot, picture, {}, {1, 2, 3}, alone}});
  }
  Result<SceneSyntax> patterns(const std::vector<PatternSyntax>& patterns) {
    Setup wide = setup;
    wide.patterns = kMaxPatterns;
    return read(PacketType::kPattern, patterns_.encode(patterns, wide, motion_->next()));
  }
  /// @param every  one picture in this many has a knot, and the last
  Result<SceneSyntax> motion(int pictures, bool key = false, int every = 1) {
    std::vector<CodedState> states;
    for (int i = 0; i < pictures; ++i) states.push_back(coded_at(motion_->next() + i));
    MotionGroup group = knots_everywhere(motion_->anchor(), states, setup.parts);
    group.key = key || motion_->groups() == 0;
    group.first = motion_->next();
    for (Track& track : group.tracks)
      std::erase_if(track,
                    [&](const Knot& k) { return (k.picture + 1) % every != 0 && k.picture + 1 < pictures; });
    return read(PacketType::kMotion, motion_->encode(group));
  }
  Result<SceneSyntax> blend(std::size_t pictures, BlendMode mode = {}, bool key = false) {
    RegionModes modes;
    modes.fill(mode);
    return read(PacketType::kBlend,
                blend_.encode({key || blend_.groups() == 0, blend_.next(), 0, std::vector(pictures, modes)}));
  }

  Setup setup = toy_setup(96, 80);
  SceneReader reader;
  bool loses = false;      // packets do not arrive
  std::size_t excess = 0;  // bytes behind each payload
  std::uint32_t check = 0;

 private:
  Bytes payload_;
  std::optional<MotionEncoder> motion_;
  PatternPacketWriter patterns_;
  BlendEncoder blend_;
};

/// A scene that has begun.
Sender begun(int patterns, int pictures) {
  Sender s(patterns);
  EXPECT_TRUE(s.begin());
  EXPECT_TRUE(s.pattern(0, 0));
  EXPECT_TRUE(s.motion(pictures));
  return s;
}

/// Whether a packet was read and nothing of it can be used.
bool skipped(const Result<SceneSyntax>& read) {
  return read && std::holds_alternative<std::monostate>(*read);
}

/// Picture numbers of the patterns of a packet, as their states tell; none for any other packet.
std::vector<int> seen_in(const Result<SceneSyntax>& read) {
  std::vector<int> out;
  if (const auto* const patterns = read ? std::get_if<std::vector<ScenePattern>>(&*read) : nullptr)
    for (const ScenePattern& p : *patterns) out.push_back(p.seen.pose[kYaw]);
  return out;
}

/// Yaws of the released pictures, and modes.
std::vector<int> shown(SceneReader& reader, std::vector<BlendMode>* modes = nullptr) {
  std::vector<int> out;
  while (reader.pictures().has_next()) {
    const State state = reader.pictures().next().state;
    out.push_back(state.pose[kYaw]);
    if (modes) modes->push_back(state.blend[0]);
  }
  return out;
}

std::vector<int> numbers(int begin, int end) {
  std::vector<int> out(static_cast<std::size_t>(end - begin));
  std::iota(out.begin(), out.end(), begin);
  return out;
}

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

// SPEC 6.6

/// Scenes of one stream, each with a sender; the reader goes from one to the next.
class Turns {
 public:
  /// A scene with a check of its own, 1, 2, ...: two pictures.
  void begin(SceneKeeping keeps, const StreamPosition& before = {}) {
    Sender& s = senders_.emplace_back(4);
    s.reader = std::move(reader);
    s.check = static_cast<std::uint32_t>(senders_.size());
    s.setup.keeps = keeps;
    s.setup.before = before;
    EXPECT_TRUE(s.begin());
    EXPECT_TRUE(s.pattern(0, 0));
    EXPECT_TRUE(s.motion(2, true));
    reader = std::move(s.reader);
  }
  Result<SceneSyntax> go_back(std::uint32_t check, bool aside = true, const StreamPosition& before = {}) {
    payload_ = encode_return({check, before, aside});
    return reader.read({PacketType::kReturn, 78, payload_, packet_size(payload_.size())});
  }
  /// What a scene sends next: `next` is called with its sender.
  template <class Next>
  Result<SceneSyntax> of(std::uint32_t check, Next&& next) {
    Sender& s = senders_[check - 1];
    s.reader = std::move(reader);
    auto read = next(s);
    reader = std::move(s.reader);
    return read;
  }
  /// Whether the stream can return to a scene now.
  bool knows(std::uint32_t check) const {
    Turns copy;
    copy.reader = reader;
    const auto read = copy.go_back(check);
    return read && !copy.reader.lost();
  }

  SceneReader reader;

 private:
  std::vector<Sender> senders_;
  Bytes payload_;
};

TEST(SceneReader, ReturnGoesOnWithThePicturesThatWait) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  ASSERT_TRUE(t.of(1, [](Sender& s) { return s.blend(1); }));
  EXPECT_EQ(shown(t.reader), numbers(0, 1));
  const std::uint64_t first = t.reader.scene();
  t.begin(SceneKeeping::kAndPresent, {1, 3000});
  EXPECT_NE(t.reader.scene(), first);
  EXPECT_TRUE(t.reader.knows(first));
  ASSERT_TRUE(t.of(2, [](Sender& s) { return s.blend(2); }));
  EXPECT_EQ(shown(t.reader), numbers(0, 2));
  const auto read = t.go_back(1, true, {3, 9000});
  ASSERT_TRUE(read);
  EXPECT_EQ(std::get<Return>(*read), (Return{1, {3, 9000}, true}));
  EXPECT_EQ(t.reader.scene(), first);
  EXPECT_EQ(t.reader.pictures().find(1)->position, (StreamPosition{3, 9000}));
  ASSERT_TRUE(t.of(1, [](Sender& s) { return s.motion(3); }));
  EXPECT_EQ(seen_in(t.of(1, [](Sender& s) { return s.pattern(1, 1); })), std::vector{1});
  ASSERT_TRUE(t.of(1, [](Sender& s) { return s.blend(4); }));
  EXPECT_EQ(shown(t.reader), numbers(1, 5));
  EXPECT_FALSE(t.reader.has_losses());
}

TEST(SceneReader, KeepsTheScenesThatItIsTold) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  t.begin(SceneKeeping::kAndPresent);
  EXPECT_TRUE(t.knows(1));
  t.begin(SceneKeeping::kAside);
  EXPECT_TRUE(t.knows(1));
  EXPECT_FALSE(t.knows(2));
  ASSERT_TRUE(t.go_back(1, false));
  EXPECT_FALSE(t.knows(3));
  t.begin(SceneKeeping::kAndPresent);
  t.begin(SceneKeeping::kNone);
  for (std::uint32_t scene = 1; scene < 5; ++scene) EXPECT_FALSE(t.knows(scene)) << scene;
}

TEST(SceneReader, KeepsNoMoreThanItsNumberOfScenes) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  for (std::size_t k = 0; k <= kKeptScenes; ++k) t.begin(SceneKeeping::kAndPresent);
  EXPECT_FALSE(t.knows(1)) << "the first that was set aside";
  for (std::uint32_t scene = 2; scene < kKeptScenes + 2; ++scene) EXPECT_TRUE(t.knows(scene)) << scene;
  for (std::uint32_t scene = 2; scene < kKeptScenes + 2; ++scene) ASSERT_TRUE(t.go_back(scene)) << scene;
}

TEST(SceneReader, ReturnToAnUnknownSceneLosesItsPackets) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  t.begin(SceneKeeping::kAndPresent);
  const auto read = t.go_back(7);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(read.error().byte_offset, 78U);
  EXPECT_TRUE(t.reader.lost());
  EXPECT_TRUE(skipped(t.of(1, [](Sender& s) { return s.motion(1); })));
  EXPECT_TRUE(skipped(t.go_back(7))) << "that is known already";
  ASSERT_TRUE(t.go_back(2));
  EXPECT_FALSE(t.reader.lost());
  EXPECT_TRUE(t.reader.has_losses()) << "its return may have been lost";
  ASSERT_TRUE(t.go_back(1));
  EXPECT_FALSE(t.reader.lost());
}

TEST(SceneReader, WhatIsLostMayHaveBeenAReturn) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  t.begin(SceneKeeping::kAndPresent);
  t.reader.lose();  // a return to 1
  ASSERT_TRUE(t.go_back(2, true, {9, 27000}));
  EXPECT_EQ(t.reader.pictures().find(0)->position, (StreamPosition{9, 27000}));
  EXPECT_TRUE(t.knows(1));
}

TEST(SceneReader, SceneWithoutItsHeadIsNotSetAside) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  Sender s(4);
  s.reader = std::move(t.reader);
  s.setup.keeps = SceneKeeping::kAndPresent;
  ASSERT_TRUE(s.begin());
  const std::uint64_t begun = s.reader.scene();
  t.reader = std::move(s.reader);
  ASSERT_TRUE(t.go_back(1));
  EXPECT_FALSE(t.reader.knows(begun));
}

TEST(SceneReader, DamagedReturnAndSetup) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  t.begin(SceneKeeping::kAndPresent);
  const Bytes damaged = {1};
  EXPECT_FALSE(t.reader.read({PacketType::kReturn, 78, damaged, packet_size(1)}));
  EXPECT_TRUE(t.reader.lost());
  EXPECT_TRUE(t.knows(1)) << "what is set aside stays";
  EXPECT_FALSE(t.reader.read({PacketType::kSetup, 78, damaged, packet_size(1)}));
  EXPECT_FALSE(t.knows(1));
}

TEST(SceneReader, SoundGoesOnThroughReturns) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  const SoundSetup voice{SoundCodec::kOpus, 1, 0, 960, 0};
  const auto sound = [&](std::int64_t first) { return encode_sound({first, {{1, 2}}}, voice); };
  const auto setup = [&](Sender& s) { return s.read(PacketType::kSoundSetup, encode_sound_setup(voice)); };
  ASSERT_TRUE(t.of(1, setup));
  t.begin(SceneKeeping::kAndPresent);
  EXPECT_FALSE(t.reader.sound_setup()) << "each setup repeats it";
  ASSERT_TRUE(t.of(2, setup));
  ASSERT_TRUE(t.of(2, [&](Sender& s) { return s.read(PacketType::kSound, sound(5)); }));
  ASSERT_TRUE(t.go_back(1));
  EXPECT_FALSE(t.of(1, [&](Sender& s) { return s.read(PacketType::kSound, sound(5)); })) << "not again";
  ASSERT_FALSE(t.go_back(7));
  EXPECT_TRUE(t.of(1, [&](Sender& s) { return s.read(PacketType::kSound, sound(6)); }));
  EXPECT_EQ(t.reader.sound_setup(), voice);
}

}  // namespace
}  // namespace fbs
