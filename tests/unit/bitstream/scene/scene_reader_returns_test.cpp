// Streams that go to and fro between scenes. SPEC 6.6
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/scene/scene_reader.h"
#include "tests/unit/bitstream/scene/scene_sender.h"

namespace fbs {
namespace {

using namespace scene_sender;  // NOLINT(google-build-using-namespace): a test's own tools

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

TEST(SceneReaderReturns, ReturnGoesOnWithThePicturesThatWait) {
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

TEST(SceneReaderReturns, KeepsTheScenesThatItIsTold) {
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

TEST(SceneReaderReturns, KeepsNoMoreThanItsNumberOfScenes) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  for (std::size_t k = 0; k <= kKeptScenes; ++k) t.begin(SceneKeeping::kAndPresent);
  EXPECT_FALSE(t.knows(1)) << "the first that was set aside";
  for (std::uint32_t scene = 2; scene < kKeptScenes + 2; ++scene) EXPECT_TRUE(t.knows(scene)) << scene;
  for (std::uint32_t scene = 2; scene < kKeptScenes + 2; ++scene) ASSERT_TRUE(t.go_back(scene)) << scene;
}

TEST(SceneReaderReturns, ReturnToAnUnknownSceneLosesItsPackets) {
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

TEST(SceneReaderReturns, WhatIsLostMayHaveBeenAReturn) {
  Turns t;
  t.begin(SceneKeeping::kNone);
  t.begin(SceneKeeping::kAndPresent);
  t.reader.lose();  // a return to 1
  ASSERT_TRUE(t.go_back(2, true, {9, 27000}));
  EXPECT_EQ(t.reader.pictures().find(0)->position, (StreamPosition{9, 27000}));
  EXPECT_TRUE(t.knows(1));
}

TEST(SceneReaderReturns, SceneWithoutItsHeadIsNotSetAside) {
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

TEST(SceneReaderReturns, DamagedReturnAndSetup) {
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

TEST(SceneReaderReturns, SoundGoesOnThroughReturns) {
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
