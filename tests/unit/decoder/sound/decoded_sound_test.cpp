#include "decoder/sound/decoded_sound.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/encoder/sound/round_trip.h"

namespace fbs::cli {
namespace {

using test::Samples;

/// A part of a voice in Opus that begins at a frame.
SoundPart voice_at(std::int64_t first, double seconds = 0.9) {
  test::CodedSound sound = test::code({SoundCodec::kOpus, 1, 16000, 20}, test::voice(48000, seconds));
  return {sound.setup, {first, std::move(sound.frames)}};
}

Samples taken(DecodedSound& sound, std::int64_t end) {
  Samples out;
  for (auto samples = sound.take(end); !samples.empty(); samples = sound.take(end)) {
    EXPECT_LE(samples.size(), 48000U);
    out.insert(out.end(), samples.begin(), samples.end());
  }
  return out;
}

bool silent(std::span<const std::int16_t> samples) {
  return std::ranges::all_of(samples, [](std::int16_t sample) { return sample == 0; });
}

TEST(DecodedSound, IsSilenceWhereThereIsNone) {
  DecodedSound sound(0);
  ASSERT_TRUE(sound.add(voice_at(0)));
  ASSERT_TRUE(sound.add(voice_at(50 * 10)));
  const Samples got = taken(sound, 12 * 48000);
  ASSERT_EQ(got.size(), 12U * 48000);
  const auto second = [&](int k) {
    return std::span(got).subspan(static_cast<std::size_t>(k) * 48000, 48000);
  };
  EXPECT_FALSE(silent(second(0)));
  for (int k = 2; k < 9; ++k) EXPECT_TRUE(silent(second(k))) << k;
  EXPECT_FALSE(silent(second(10)));
}

TEST(DecodedSound, BeginsAtATime) {
  DecodedSound whole(0), late(24000);
  ASSERT_TRUE(whole.add(voice_at(0)));
  ASSERT_TRUE(late.add(voice_at(0)));
  const Samples all = taken(whole, 40000), rest = taken(late, 40000);
  ASSERT_EQ(rest.size(), 16000U);
  EXPECT_TRUE(std::equal(rest.begin(), rest.end(), all.begin() + 24000));
}

TEST(DecodedSound, PartsOfAnyTimeTakeNoTimeAndMemory) {
  DecodedSound sound(0);
  ASSERT_TRUE(sound.add(voice_at(0)));
  ASSERT_TRUE(sound.add(voice_at(kMaxSoundFrames - 100)));
  EXPECT_EQ(taken(sound, 48000).size(), 48000U);
  // A year later, the part is not decoded yet, and nothing before it is filled.
  DecodedSound joined(kMaxSoundFrames / 2 * 960);
  ASSERT_TRUE(joined.add(voice_at(0)));
  ASSERT_TRUE(joined.add(voice_at(kMaxSoundFrames / 2)));
  const Samples got = taken(joined, kMaxSoundFrames / 2 * 960 + 96000);
  EXPECT_EQ(got.size(), 96000U);
  EXPECT_FALSE(silent(std::span(got).first(48000)));
}

TEST(DecodedSound, HoldsNoMoreThanItsLimit) {
  constexpr int kFull = 16;  // parts, of which none is Opus
  for (const int parts : {kFull - 1, kFull}) {
    DecodedSound sound(48000 * kFull);
    for (int k = 0; k < parts; ++k) {
      SoundPart part{{SoundCodec::kOpus, 1, 0, 480, 312}, {k * 64, {}}};
      part.group.frames.assign(64, std::vector<std::uint8_t>(kMaxSoundAhead / kFull / 64 - 64, 0xFF));
      ASSERT_EQ(memory_of(part.group), kMaxSoundAhead / kFull);
      ASSERT_TRUE(sound.add(std::move(part)));
    }
    ASSERT_TRUE(sound.add(voice_at(50 * kFull)));
    EXPECT_EQ(silent(taken(sound, 48000 * (kFull + 1))), parts == kFull);
  }
}

TEST(DecodedSound, RefusesWhatNoDecoderKnows) {
  SoundPart part = voice_at(0);
  part.setup.duration = 961;
  EXPECT_FALSE(DecodedSound(0).add(part));
}

}  // namespace
}  // namespace fbs::cli
