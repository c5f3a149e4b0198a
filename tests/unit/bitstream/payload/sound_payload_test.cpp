#include "bitstream/payload/sound_payload.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

constexpr SoundSetup kVoice{SoundCodec::kOpus, 1, 0, 2880, 312};
constexpr SoundSetup kRadio{SoundCodec::kCodec2, 1, 1300, 1920, 0};

std::vector<std::uint8_t> frame(std::size_t size, std::uint8_t value) {
  return std::vector<std::uint8_t>(size, value);
}

ErrorCode code_of(const std::vector<std::uint8_t>& payload) {
  const auto read = decode_sound_setup(payload);
  return read ? ErrorCode::kInternal : read.error().code;
}

TEST(SoundSetupPayload, ComesBackAsItWas) {
  for (const SoundSetup& setup : {kVoice, kRadio, SoundSetup{SoundCodec::kOpus, 2, 0, 120, kMaxSoundSkip}}) {
    const auto payload = encode_sound_setup(setup);
    ASSERT_TRUE(payload);
    const auto read = decode_sound_setup(*payload);
    ASSERT_TRUE(read) << read.error().text;
    EXPECT_EQ(*read, setup);
  }
}

TEST(SoundSetupPayload, ReadsKnownBytesAndIgnoresWhatFollows) {
  const auto read = decode_sound_setup(std::vector<std::uint8_t>{2, 1, 0x94, 0x0A, 0x80, 0x0F, 7, 99, 99});
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (SoundSetup{SoundCodec::kCodec2, 1, 1300, 1920, 7}));
}

TEST(SoundSetupPayload, CodecsAndModesOfTheFutureAreLeftOut) {
  EXPECT_EQ(decode_sound_setup(std::vector<std::uint8_t>{3}).value(), std::nullopt);
  EXPECT_EQ(decode_sound_setup(std::vector<std::uint8_t>{2, 1, 0xBC, 0x05, 0x80, 0x0F, 0}).value(),
            std::nullopt)
      << "700 bit/s";
}

TEST(SoundSetupPayload, RefusesWhatIsOutOfRange) {
  const auto good = encode_sound_setup(kVoice).value();
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_EQ(code_of({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}),
              ErrorCode::kTruncated);
  EXPECT_EQ(code_of({0}), ErrorCode::kInvalidStream) << "no codec";
  EXPECT_EQ(code_of({1, 3, 0, 0x80, 0x0F, 0}), ErrorCode::kInvalidStream) << "three channels";
  EXPECT_EQ(code_of({1, 1, 1, 0x80, 0x0F, 0}), ErrorCode::kInvalidStream) << "a mode of Opus";
  EXPECT_EQ(code_of({1, 1, 0, 0x81, 0x0F, 0}), ErrorCode::kInvalidStream) << "a duration that Opus has not";
  EXPECT_EQ(code_of({2, 2, 0x94, 0x0A, 0x80, 0x0F, 0}), ErrorCode::kInvalidStream) << "Codec 2 in stereo";
  EXPECT_EQ(code_of({2, 1, 0x94, 0x0A, 0xC0, 0x07, 0}), ErrorCode::kInvalidStream)
      << "another mode's duration";
  EXPECT_EQ(code_of({1, 1, 0, 0x80, 0x0F, 0x81, 0xF7, 0x02}), ErrorCode::kInvalidStream)
      << "more than a second";
  for (SoundSetup bad : {kVoice, kRadio}) {
    bad.channels = 3;
    EXPECT_FALSE(encode_sound_setup(bad));
  }
}

TEST(SoundPayload, ComesBackAsItWas) {
  const SoundGroup opus{123456789, {frame(3, 1), {}, frame(kMaxSoundFrame, 2)}};
  EXPECT_EQ(decode_sound(encode_sound(opus, kVoice).value(), kVoice).value(), opus);
  const SoundGroup codec2{0, {frame(7, 1), frame(7, 2)}};
  const auto payload = encode_sound(codec2, kRadio).value();
  EXPECT_EQ(payload.size(), 15U) << "no sizes";
  EXPECT_EQ(decode_sound(payload, kRadio).value(), codec2);
}

TEST(SoundPayload, HasUpToASecond) {
  SoundGroup second{0, {}};
  second.frames.assign(17, frame(1, 1));  // of 60 ms
  const auto payload = encode_sound(second, kVoice);
  ASSERT_TRUE(payload);
  EXPECT_TRUE(decode_sound(*payload, kVoice));
  second.frames.push_back(frame(1, 1));
  EXPECT_FALSE(encode_sound(second, kVoice));
  std::vector<std::uint8_t> longer = *payload;
  longer.insert(longer.end(), {1, 1});
  EXPECT_EQ(decode_sound(longer, kVoice).error().code, ErrorCode::kTooLarge);
}

TEST(SoundPayload, RefusesWhatIsOutOfRange) {
  const auto code = [](const std::vector<std::uint8_t>& payload, const SoundSetup& setup) {
    const auto read = decode_sound(payload, setup);
    return read ? ErrorCode::kInternal : read.error().code;
  };
  EXPECT_EQ(code({}, kVoice), ErrorCode::kTruncated);
  EXPECT_EQ(code({0}, kVoice), ErrorCode::kTruncated) << "no frame";
  EXPECT_EQ(code({0, 2, 1}, kVoice), ErrorCode::kTruncated);
  EXPECT_EQ(code({0, 0xDD, 0x0B}, kVoice), ErrorCode::kTooLarge) << "1501 bytes";
  EXPECT_EQ(code({0, 0x80, 0x00}, kVoice), ErrorCode::kInvalidStream) << "not the shortest form";
  EXPECT_EQ(code({0x80, 0x80, 0x80, 0x80, 0x10, 0}, kVoice), ErrorCode::kInvalidStream) << "2^32";
  EXPECT_EQ(code({0, 1, 2, 3, 4, 5, 6}, kRadio), ErrorCode::kTruncated) << "six of seven bytes";
  EXPECT_FALSE(encode_sound({0, {}}, kVoice));
  EXPECT_FALSE(encode_sound({-1, {frame(1, 1)}}, kVoice));
  EXPECT_FALSE(encode_sound({0, {frame(kMaxSoundFrame + 1, 1)}}, kVoice));
  EXPECT_FALSE(encode_sound({0, {frame(6, 1)}}, kRadio));
}

}  // namespace
}  // namespace fbs
