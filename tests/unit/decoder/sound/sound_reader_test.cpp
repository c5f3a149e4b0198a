#include "decoder/sound/sound_reader.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/sound/round_trip.h"

namespace fbs {
namespace {

using test::CodedSound;
using test::Samples;

CodedSound opus(int frame_ms = 20) {
  return test::code({SoundCodec::kOpus, 1, 16000, frame_ms}, test::voice(48000, 2));
}

CodedSound codec2() {
  return test::code({SoundCodec::kCodec2, 1, 3200, 20}, test::voice(8000, 2));
}

SoundGroup group_of(const CodedSound& sound, std::ptrdiff_t first, std::ptrdiff_t count) {
  return {first, {sound.frames.begin() + first, sound.frames.begin() + first + count}};
}

SoundReader reader_of(const CodedSound& sound) {
  SoundReader reader;
  EXPECT_TRUE(reader.set(sound.setup));
  return reader;
}

/// Reads groups of so many frames.
Samples read_in_groups(const CodedSound& sound, std::ptrdiff_t count) {
  SoundReader reader = reader_of(sound);
  Samples out;
  for (std::ptrdiff_t first = 0; first < std::ssize(sound.frames); first += count) {
    EXPECT_TRUE(reader.add(group_of(sound, first, std::min(count, std::ssize(sound.frames) - first))));
    const Samples part = test::read_rest(reader);
    out.insert(out.end(), part.begin(), part.end());
  }
  return out;
}

TEST(SoundReader, TheFirstSampleIsThatOfTheFirstPicture) {
  for (const CodedSound& sound : {opus(), codec2()}) {
    SoundReader reader = reader_of(sound);
    ASSERT_TRUE(reader.add(group_of(sound, 0, 10)));
    std::int64_t begin = -1;
    const Samples read = test::read_rest(reader, &begin);
    EXPECT_EQ(begin, 0);
    const auto ticks =
        static_cast<std::int64_t>(read.size()) * (sound.setup.codec == SoundCodec::kOpus ? 1 : 6);
    EXPECT_EQ(ticks, 10 * sound.setup.duration - sound.setup.skip);
  }
}

TEST(SoundReader, GroupsMakeNoDifference) {
  const CodedSound sound = opus();
  EXPECT_EQ(read_in_groups(sound, 1), read_in_groups(sound, 10));
}

TEST(SoundReader, ASkipOfMoreThanAFrameIsDropped) {
  CodedSound sound = opus();
  const Samples whole = read_in_groups(sound, 10);
  sound.setup.skip += 2 * 960;
  const Samples later = read_in_groups(sound, 10);
  EXPECT_EQ(Samples(whole.begin() + 2 * 960, whole.end()), later);
}

TEST(SoundReader, AGapIsFilledToItsLength) {
  for (const CodedSound& sound : {opus(), codec2()}) {
    const int rate = sound.setup.codec == SoundCodec::kOpus ? 48000 : 8000;
    SoundReader reader = reader_of(sound);
    ASSERT_TRUE(reader.add(group_of(sound, 0, 20)));
    const Samples before = test::read_rest(reader);
    ASSERT_TRUE(reader.add(group_of(sound, 40, 1)));
    std::int64_t begin = 0;
    const Samples gap = test::read_rest(reader, &begin);
    EXPECT_EQ(begin, 20 * 960 - sound.setup.skip);
    ASSERT_EQ(gap.size(), static_cast<std::size_t>(rate) / 50 * 21);
    EXPECT_GT(test::energy(std::span(gap).first(static_cast<std::size_t>(rate) / 50)), 0);
    // 100 ms are concealed: then silence, to which the concealment leads without a step.
    const auto concealed = static_cast<std::size_t>(rate) / 10;
    EXPECT_EQ(test::energy(std::span(gap).subspan(concealed, static_cast<std::size_t>(rate) / 50 * 15)), 0);
    EXPECT_LE(std::abs(gap[concealed - 1]), 200);
  }
}

TEST(SoundReader, WhatIsMarkedAsLostIsConcealed) {
  CodedSound sound = opus();
  const Samples whole = read_in_groups(sound, 100);
  sound.frames[20].clear();
  const Samples concealed = read_in_groups(sound, 100);
  ASSERT_EQ(concealed.size(), whole.size());
  const std::size_t lost = 20 * 960 - static_cast<std::size_t>(sound.setup.skip);
  EXPECT_TRUE(
      std::equal(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(lost), concealed.begin()));
  EXPECT_GT(test::energy(std::span(concealed).subspan(lost, 960)), 0);
  EXPECT_NE(concealed, whole);
}

TEST(SoundReader, FramesThatCameBeforeAreLeftOut) {
  const CodedSound sound = opus();
  const Samples whole = read_in_groups(sound, 20);
  SoundReader reader = reader_of(sound);
  ASSERT_TRUE(reader.add(group_of(sound, 0, 10)));
  Samples read = test::read_rest(reader);
  ASSERT_TRUE(reader.add(group_of(sound, 2, 5)));
  EXPECT_TRUE(test::read_rest(reader).empty());
  ASSERT_TRUE(reader.add(group_of(sound, 5, 15)));
  const Samples more = test::read_rest(reader);
  read.insert(read.end(), more.begin(), more.end());
  EXPECT_TRUE(std::equal(read.begin(), read.end(), whole.begin()));
  EXPECT_EQ(read.size(), 20U * 960 - static_cast<std::size_t>(sound.setup.skip));
}

TEST(SoundReader, AStreamMayBeginLate) {
  const CodedSound sound = opus();
  SoundReader reader = reader_of(sound);
  ASSERT_TRUE(reader.add(group_of(sound, 7, 3)));
  std::int64_t begin = 0;
  EXPECT_EQ(test::read_rest(reader, &begin).size(), 3U * 960);
  EXPECT_EQ(begin, 7 * 960 - sound.setup.skip);
}

TEST(SoundReader, AfterAResetThereIsNoGap) {
  const CodedSound sound = opus();
  SoundReader reader = reader_of(sound);
  for (const std::ptrdiff_t first : {50, 3, 80}) {
    reader.reset();
    ASSERT_TRUE(reader.add(group_of(sound, first, 2)));
    std::int64_t begin = 0;
    EXPECT_EQ(test::read_rest(reader, &begin).size(), 2U * 960);
    EXPECT_EQ(begin, first * 960 - sound.setup.skip);
  }
}

TEST(SoundReader, TheSameSetupAgainChangesNothing) {
  const CodedSound sound = opus();
  SoundReader reader = reader_of(sound);
  ASSERT_TRUE(reader.add(group_of(sound, 0, 10)));
  Samples read = test::read_rest(reader);
  ASSERT_TRUE(reader.set(sound.setup));
  ASSERT_TRUE(reader.add(group_of(sound, 10, 10)));
  const Samples more = test::read_rest(reader);
  read.insert(read.end(), more.begin(), more.end());
  const Samples whole = read_in_groups(sound, 20);
  EXPECT_TRUE(std::equal(read.begin(), read.end(), whole.begin()));
}

TEST(SoundReader, AnotherCodecTakesOverAtItsTime) {
  const CodedSound first = opus(60), second = codec2();
  SoundReader reader = reader_of(first);
  ASSERT_TRUE(reader.add(group_of(first, 0, 10)));
  const auto end = static_cast<std::int64_t>(test::read_rest(reader).size());
  ASSERT_TRUE(reader.set(second.setup));
  ASSERT_TRUE(reader.add(group_of(second, 25, 20)));  // some of these are of times that have been given
  SoundPiece piece;
  std::int64_t begin = -1, samples = 0;
  for (auto more = reader.next(piece); more && *more; more = reader.next(piece)) {
    EXPECT_EQ(piece.sample_rate, 8000);
    if (begin < 0) begin = piece.time;
    samples += std::ssize(piece.samples);
  }
  EXPECT_GE(begin, end);
  EXPECT_LT(begin, end + 6);
  EXPECT_EQ(begin + samples * 6, 45 * 960 - second.setup.skip);
}

TEST(SoundReader, AWrongFrameIsToldOnceAndConcealed) {
  CodedSound sound = opus();
  sound.frames[3] = {0x4B};
  SoundReader reader = reader_of(sound);
  ASSERT_TRUE(reader.add(group_of(sound, 0, 10)));
  SoundPiece piece;
  std::size_t samples = 0;
  int errors = 0;
  for (auto more = reader.next(piece); !more || *more; more = reader.next(piece)) {
    if (!more) {
      EXPECT_EQ(more.error().code, ErrorCode::kInvalidStream);
      ASSERT_EQ(++errors, 1);
    }
    samples += piece.samples.size();
  }
  EXPECT_EQ(errors, 1);
  EXPECT_EQ(samples, 10U * 960 - static_cast<std::size_t>(sound.setup.skip));
}

TEST(SoundReader, AGapOfDaysIsNoMoreThanAFrameAtATime) {
  const CodedSound sound = opus();
  SoundReader reader = reader_of(sound);
  ASSERT_TRUE(reader.add(group_of(sound, 0, 2)));
  static_cast<void>(test::read_rest(reader));
  ASSERT_TRUE(reader.add({kMaxSoundFrames - 1, {sound.frames[5]}}));
  SoundPiece piece;
  for (int i = 0; i < 1000; ++i) {
    const auto more = reader.next(piece);
    ASSERT_TRUE(more && *more);
    EXPECT_EQ(piece.samples.size(), 960U);
    EXPECT_LE(piece.samples.capacity(), 2 * 960U);
  }
}

TEST(SoundReader, RefusesGroupsThatCannotBe) {
  const CodedSound sound = opus();
  SoundReader reader;
  EXPECT_EQ(reader.add(group_of(sound, 0, 1)).error().code, ErrorCode::kInvalidStream);  // no setup
  ASSERT_TRUE(reader.set(sound.setup));
  EXPECT_EQ(reader.add({-1, {{}}}).error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(reader.add({kMaxSoundFrames, {{}}}).error().code, ErrorCode::kInvalidStream);
  EXPECT_TRUE(reader.add(group_of(sound, 0, 1)));
  EXPECT_FALSE(test::read_rest(reader).empty());

  SoundSetup wrong = sound.setup;
  wrong.duration = 1;
  EXPECT_EQ(reader.set(wrong).error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(reader.add(group_of(sound, 1, 1)).error().code, ErrorCode::kInvalidStream);
  EXPECT_TRUE(test::read_rest(reader).empty());
}

}  // namespace
}  // namespace fbs
