#include "cli/play/sound/sound_playback.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "common/picture.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {
namespace {

constexpr std::int64_t kSecond = kSoundClock;
constexpr auto kAll = std::numeric_limits<std::int64_t>::max();

/// Three seconds whose loudness tells the time: a square wave, a quarter of a second off and on.
std::vector<std::int16_t> beats() {
  std::vector<std::int16_t> out(3 * kSecond);
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = k / 12000 % 2 == 0 ? 0 : static_cast<std::int16_t>(k / 50 % 2 == 0 ? 6000 : -6000);
  return out;
}

/// Their sound packets, each of half a second, behind a setup packet.
std::vector<std::uint8_t> coded_beats() {
  auto encoder = SoundEncoder::create({.bitrate = 64000, .frame_ms = 20}).value();
  SoundEncoder::Frames frames;
  EXPECT_TRUE(encoder->add(beats(), frames));
  EXPECT_TRUE(encoder->finish(frames));
  std::vector<std::uint8_t> out;
  write_signature(out);
  PacketWriter writer;
  Setup setup;
  setup.format.width = setup.format.height = kMinPictureSize;
  writer.write(out, PacketType::kSetup, encode_setup(setup).value());
  writer.write(out, PacketType::kSoundSetup, encode_sound_setup(encoder->setup()).value());
  for (std::size_t k = 0; k < frames.size(); k += 25) {
    SoundGroup group{static_cast<std::int64_t>(k), {}};
    for (std::size_t n = k; n < std::min(k + 25, frames.size()); ++n) group.frames.push_back(frames[n]);
    writer.write(out, PacketType::kSound, encode_sound(group, encoder->setup()).value());
  }
  return out;
}

SoundParts parts_of(std::span<const std::uint8_t> stream) {
  SoundParts parts;
  parts.add(stream);
  return parts;
}

/// Whether what begins at that time beats as beats() does.
void expect_beats(std::span<const std::int16_t> samples, std::int64_t time) {
  for (std::size_t k = 0; k + 480 <= samples.size(); k += 480) {
    const std::int64_t at = (time + static_cast<std::int64_t>(k)) % 24000;
    if (at % 12000 < 960 || at % 12000 > 11000) continue;  // where it changes
    int loudest = 0;
    for (const std::int16_t s : samples.subspan(k, 480)) loudest = std::max(loudest, std::abs(s));
    EXPECT_EQ(loudest > 2000, at >= 12000) << time << " + " << k;
  }
}

TEST(SoundCursor, GivesTheSameSamplesInPiecesOfAnySize) {
  const SoundParts parts = parts_of(coded_beats());
  SoundCursor whole(parts, kSoundClock, 1), pieces(parts, kSoundClock, 1);
  const auto all = whole.take(3 * kSecond);
  std::vector<std::int16_t> joined;
  for (std::int64_t end = 777; joined.size() < all.size(); end += 777) {
    const auto piece = pieces.take(std::min(end, 3 * kSecond));
    joined.insert(joined.end(), piece.begin(), piece.end());
  }
  EXPECT_EQ(joined, all);
  expect_beats(all, 0);
}

TEST(SoundCursor, SeekGoesToTheSample) {
  const SoundParts parts = parts_of(coded_beats());
  SoundCursor cursor(parts, kSoundClock, 1);
  for (const std::int64_t time : {70000, 30, 119000}) {
    cursor.seek(time);
    const auto samples = cursor.take(time + 20000);
    EXPECT_EQ(samples.size(), 20000U);
    EXPECT_EQ(cursor.time(), time + 20000);
    expect_beats(samples, time);
  }
}

TEST(SoundCursor, SoundThatHasNotComeIsSilenceAndWhatComesKeepsItsPlace) {
  const auto stream = coded_beats();
  SoundParts parts;
  SoundCursor cursor(parts, kSoundClock, 1);
  const auto none = cursor.take(30000);
  EXPECT_EQ(std::ranges::count(none, 0), 30000);
  parts.add(stream);
  const auto samples = cursor.take(100000);
  EXPECT_EQ(samples.size(), 70000U);
  expect_beats(samples, 30000);
}

TEST(SoundCursor, BehindTheLastPartIsSilence) {
  const SoundParts parts = parts_of(coded_beats());
  SoundCursor cursor(parts, kSoundClock, 1);
  cursor.seek(4 * kSecond);
  const auto samples = cursor.take(5 * kSecond);
  EXPECT_EQ(std::ranges::count(samples, 0), kSecond);
}

TEST(SoundParts, AreTheSameFromPiecesOfAnySize) {
  const auto stream = coded_beats();
  const SoundParts whole = parts_of(stream);
  SoundParts pieces;
  for (std::size_t k = 0; k < stream.size(); k += 13)
    pieces.add(std::span(stream).subspan(k, std::min<std::size_t>(13, stream.size() - k)));
  ASSERT_EQ(whole.all().size(), 7U);  // the encoder's delay goes into one more
  ASSERT_EQ(pieces.all().size(), 7U);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(pieces.all()[k].group, whole.all()[k].group);
  EXPECT_EQ(begin_of(whole.all()[2]) - begin_of(whole.all()[1]), kSecond / 2);
}

TEST(SoundParts, AfterDamageGoOnWithWhatIsFound) {
  const auto scene = coded_beats();
  auto stream = scene;
  stream[stream.size() / 2] ^= 0x55;
  SoundParts parts = parts_of(stream);
  ASSERT_EQ(parts.all().size(), 3U)
      << "those before it, and the only one behind it that is short enough to be found";
  EXPECT_EQ(parts.all()[1].group.first, 25);
  EXPECT_EQ(parts.all()[2].group.first, 150);
  parts.add(std::span(scene).subspan(kSignature.size()));
  EXPECT_EQ(parts.all().size(), 3U) << "of the second scene those with numbers that rise";
}

TEST(SoundPlayback, DecodesSoFarAheadAndNoFurtherThanIsKnown) {
  const SoundParts parts = parts_of(coded_beats());
  SoundPlayback sound(parts, kSoundClock, 1);
  sound.start(0);
  sound.fill(kSecond / 4);
  EXPECT_EQ(sound.queue().waiting(), kSecond / 4);
  sound.fill(kAll);
  EXPECT_EQ(sound.queue().waiting(), kSecond);
  std::vector<std::int16_t> block(4800);
  sound.queue().fetch(block, {});
  sound.fill(kAll);
  EXPECT_EQ(sound.queue().waiting(), kSecond);
}

TEST(SoundPlayback, GoesOnInSilenceBehindTheSound) {
  const SoundParts parts = parts_of(coded_beats());
  SoundPlayback sound(parts, kSoundClock, 1);
  sound.start(10 * kSecond);
  sound.fill(kAll);
  EXPECT_EQ(sound.queue().waiting(), kSecond);
  EXPECT_EQ(sound.heard({}), 10 * kSecond);
}

TEST(SoundPlayback, StopLeavesNothingToBeHeard) {
  const SoundParts parts = parts_of(coded_beats());
  SoundPlayback sound(parts, kSoundClock, 1);
  sound.start(0);
  sound.fill(kAll);
  sound.stop();
  EXPECT_FALSE(sound.started());
  EXPECT_EQ(sound.queue().waiting(), 0);
}

TEST(SoundTime, RoundedDurationsDoNotAddUp) {
  const Rational rate{24000, 1001};
  StreamPosition position;
  for (int k = 0; k < 24000; ++k) position.add(nominal_duration(rate));
  EXPECT_EQ(sound_time(position, rate), 1001 * kSecond);
}

TEST(SoundTime, DurationsOfTheirOwnCount) {
  StreamPosition position;
  position.add(nominal_duration({25, 1}));
  position.add(kTicksPerSecond);
  EXPECT_EQ(sound_time(position, {25, 1}), kSecond + kSecond / 25);
}

TEST(Volume, SaysWhatIsNotAsInTheStream) {
  Volume volume;
  EXPECT_EQ(volume.text(), "");
  EXPECT_EQ(volume.gain(), 1);
  volume.change(-3);
  EXPECT_EQ(volume.text(), "volume 70 %");
  EXPECT_NEAR(volume.gain(), 0.49, 1e-9);
  volume.toggle_mute();
  EXPECT_EQ(volume.text(), "muted");
  EXPECT_EQ(volume.gain(), 0);
  volume.change(1);
  EXPECT_EQ(volume.text(), "volume 80 %");
  volume.change(100);
  EXPECT_EQ(volume.gain(), 1);
}

}  // namespace
}  // namespace fbs::cli
