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

/// Reads groups of `count` frames.
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
  for (const SoundCodec codec : {SoundCodec::kOpus, SoundCodec::kCodec2}) {
    const SoundSettings settings{codec, 1, 16000, 20};
    const int rate = test::rate_of(settings);
    const auto frame = static_cast<std::size_t>(rate / 50);
    const CodedSound sound = test::code(settings, test::vowel(rate, 1));
    SoundReader reader = reader_of(sound);
    ASSERT_TRUE(reader.add(group_of(sound, 0, 20)));
    const Samples before = test::read_rest(reader);
    ASSERT_TRUE(reader.add(group_of(sound, 40, 1)));
    std::int64_t begin = 0;
    const Samples gap = test::read_rest(reader, &begin);
    EXPECT_EQ(begin, 20 * 960 - sound.setup.skip);
    ASSERT_EQ(gap.size(), 21 * frame);
    EXPECT_GT(test::energy(std::span(gap).first(frame)), test::energy(std::span(before).last(frame)) / 4);
    // 100 ms are concealed: then silence, to which the concealment leads without a step.
    EXPECT_EQ(test::energy(std::span(gap).subspan(5 * frame, 15 * frame)), 0);
    EXPECT_GT(test::energy(std::span(gap).subspan(4 * frame, frame)), 0);
    EXPECT_LT(test::energy(std::span(gap).subspan(5 * frame - frame / 8, frame / 8)),
              test::energy(std::span(gap).subspan(4 * frame, frame / 2)) / 20);
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
  ASSERT_TRUE(reader.add(group_of(sound, 9, 11)));
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

/// Begins with 600 ms in frames of 10 ms; then some of Codec 2, from number `first`.
void change_codec(std::ptrdiff_t first, std::int64_t& end, std::vector<SoundPiece>& pieces) {
  const CodedSound before = opus(10), after = codec2();
  SoundReader reader = reader_of(before);
  ASSERT_TRUE(reader.add(group_of(before, 0, 60)));
  end = std::ssize(test::read_rest(reader));
  ASSERT_TRUE(reader.set(after.setup));
  ASSERT_TRUE(reader.add(group_of(after, first, 20)));
  SoundPiece piece;
  for (auto more = reader.next(piece); more && *more; more = reader.next(piece)) pieces.push_back(piece);
  ASSERT_FALSE(pieces.empty());
  for (const SoundPiece& p : pieces) EXPECT_EQ(p.sample_rate, 8000);
  EXPECT_EQ(pieces.back().time + std::ssize(pieces.back().samples) * 6,
            (first + 20) * 960 - after.setup.skip);
}

TEST(SoundReader, AnotherCodecTakesOverWhereTheFirstEnds) {
  std::vector<SoundPiece> pieces;
  std::int64_t end = 0;
  change_codec(25, end, pieces);  // some are of times that have been given
  ASSERT_FALSE(pieces.empty());
  EXPECT_GE(pieces.front().time, end);
  EXPECT_LT(pieces.front().time, end + 6);
}

TEST(SoundReader, BeforeAnotherCodecIsSilence) {
  std::vector<SoundPiece> pieces;
  std::int64_t end = 0;
  change_codec(35, end, pieces);
  ASSERT_GT(pieces.size(), 20U);
  EXPECT_EQ(pieces.front().time, end);
  const std::size_t silent = pieces.size() - 20;
  EXPECT_EQ(pieces[silent].time, 35 * 960 - codec2().setup.skip);
  for (std::size_t i = 0; i < silent; ++i) EXPECT_EQ(test::energy(pieces[i].samples), 0);
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
