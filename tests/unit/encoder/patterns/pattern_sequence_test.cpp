#include "encoder/patterns/pattern_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/quality.h"
#include "decoder/pattern/pattern_decoder.h"
#include "decoder/pattern/upscale.h"
#include "encoder/patterns/downscale.h"
#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

std::vector<Picture> pan(int width, int height, int count) {
  std::vector<Picture> out;
  for (int i = 0; i < count; ++i) out.push_back(scenery(width, height, 3 * i));
  return out;
}

SequenceSettings settings_of(int quantiser, bool reduced = false) {
  SequenceSettings s;
  s.quantiser = quantiser;
  s.speed = 6;
  s.reduced = reduced;
  return s;
}

std::vector<SequencePattern> sequence_of(std::span<const Picture> pictures,
                                         const SequenceSettings& settings) {
  const VideoFormat format = format_of(pictures[0].width(), pictures[0].height());
  auto out = code_pattern_sequence(format, pictures, settings);
  EXPECT_TRUE(out) << out.error().text;
  return out ? std::move(*out) : std::vector<SequencePattern>{};
}

std::size_t bytes_of(std::span<const SequencePattern> patterns) {
  std::size_t sum = 0;
  for (const SequencePattern& p : patterns) sum += p.av1.size();
  return sum;
}

/// A frame header's first bits are show_existing_frame, two of frame_type and show_frame.
bool is_hidden(const SequencePattern& inter) {
  return (inter.av1.at(1) & 0x10) == 0;
}

TEST(PatternSequence, CodesEachPictureOnceAndTheFirstFirst) {
  for (const int count : {1, 2, 3, 5, 8, 9, 10, 16, 17, 18, 26, 33, 64, 150, 300}) {
    const auto pictures = pan(64, 64, count);
    const auto coded = sequence_of(pictures, settings_of(40));
    ASSERT_EQ(coded.size(), pictures.size());
    EXPECT_EQ(coded[0].picture, 0U);
    std::vector<int> times(pictures.size());
    for (const SequencePattern& p : coded) ++times[p.picture];
    EXPECT_EQ(std::ranges::count(times, 1), count);
  }
}

// libaom codes a picture that stands still a second time to show it; that is left out.
TEST(PatternSequence, CodesAStillOnceForEachPicture) {
  const std::vector<Picture> pictures(18, scenery(96, 80));
  const auto coded = sequence_of(pictures, settings_of(30));
  EXPECT_EQ(coded.size(), pictures.size());
  EXPECT_LT(bytes_of(coded), coded[0].av1.size() + 17 * 25) << "little more than frame headers";
}

TEST(PatternSequence, PatternsAreThePicturesTheyClaimToBe) {
  const auto pictures = pan(96, 80, 20);
  for (const SequencePattern& p : sequence_of(pictures, settings_of(20))) {
    const auto psnr = [&](std::size_t picture) {
      return squared_error(pictures[picture].y, p.decoded.y).psnr();
    };
    for (std::size_t other = 0; other < pictures.size(); ++other)
      EXPECT_TRUE(other == p.picture || psnr(p.picture) > psnr(other) + 3) << p.picture << " or " << other;
  }
}

TEST(PatternSequence, LooksAheadWithHiddenFrames) {
  const auto coded = sequence_of(pan(64, 64, 16), settings_of(40));
  EXPECT_FALSE(std::ranges::is_sorted(coded, {}, &SequencePattern::picture));
  const std::span<const SequencePattern> inter = std::span(coded).subspan(1);
  EXPECT_TRUE(std::ranges::any_of(inter, is_hidden));
  EXPECT_FALSE(std::ranges::all_of(inter, is_hidden));
}

TEST(PatternSequence, AFreshDecoderShowsTheSamePacketByPacket) {
  for (const auto& [w, h, reduced] :
       {std::tuple{96, 80, false}, {67, 65, false}, {96, 80, true}, {67, 65, true}, {64, 64, true}}) {
    auto decoder = PatternDecoder::create(w, h);
    ASSERT_TRUE(decoder);
    for (const SequencePattern& p : sequence_of(pan(w, h, 11), settings_of(45, reduced))) {
      const auto shown = decoder->decode_frame(p.av1);
      ASSERT_TRUE(shown) << shown.error().text;
      EXPECT_EQ(shown->picture, p.decoded);
      EXPECT_EQ(shown->order_hint, static_cast<int>(p.picture));
      EXPECT_EQ(shown->reduced, reduced);
    }
  }
}

TEST(PatternSequence, IsTheSameEachTime) {
  const auto pictures = pan(96, 80, 9);
  const auto once = sequence_of(pictures, settings_of(40)), again = sequence_of(pictures, settings_of(40));
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].av1, again[i].av1) << i;
}

TEST(PatternSequence, BoostSpendsOnTheFirst) {
  const auto pictures = pan(96, 80, 9);
  SequenceSettings even = settings_of(50), boosted = settings_of(50);
  even.boost = 0;
  boosted.boost = 20;
  EXPECT_GT(sequence_of(pictures, boosted)[0].av1.size(), sequence_of(pictures, even)[0].av1.size() * 5 / 4);
}

TEST(PatternSequence, ReducedPatternsAreSmallAndEnlarged) {
  const auto pictures = pan(131, 97, 5);
  const auto full = sequence_of(pictures, settings_of(30)),
             half = sequence_of(pictures, settings_of(30, true));
  EXPECT_LT(bytes_of(half), bytes_of(full) * 3 / 4);
  for (const SequencePattern& p : half) {
    ASSERT_EQ(p.decoded.width(), 131);
    ASSERT_EQ(p.decoded.height(), 97);
    const Picture best = upscaled(downscaled(pictures[p.picture]), 131, 97);
    EXPECT_GT(squared_error(best.y, p.decoded.y).psnr(), 33);
  }
}

TEST(PatternSequence, RefusesWhatItCannotCode) {
  const auto code = [](std::vector<Picture> pictures, int quantiser) {
    return code_pattern_sequence(format_of(64, 64), pictures, settings_of(quantiser)).error().code;
  };
  EXPECT_EQ(code({}, 40), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(std::vector<Picture>(kMaxSequencePictures + 1, Picture(64, 64)), 40),
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(code({Picture(64, 64), Picture(64, 66)}, 40), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code({Picture(64, 64)}, 64), ErrorCode::kInvalidArgument);
}

TEST(PatternDecoder, TakesExactlyOneFrame) {
  const auto coded = sequence_of(pan(64, 64, 6), settings_of(40));
  const auto& key = coded[0].av1;
  const auto join = [](std::vector<std::uint8_t> a, const std::vector<std::uint8_t>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  // A frame with a size field, so that another unit can follow it.
  std::vector<std::uint8_t> sized = coded[1].av1;
  ASSERT_LT(sized.size(), 128U);
  sized[0] |= 0x02;
  sized.insert(sized.begin() + 1, static_cast<std::uint8_t>(sized.size() - 1));

  auto decoder = PatternDecoder::create(64, 64);
  ASSERT_TRUE(decoder->decode(key));
  for (const auto& packet : {join(sized, coded[2].av1), join({0x12, 0x00}, coded[1].av1),
                             join(sized, {0x1A, 1, 0x80}), std::vector<std::uint8_t>{0x1A, 1, 0x80},
                             std::vector<std::uint8_t>(key.begin(), key.begin() + 2 + key[1]),
                             join(std::vector<std::uint8_t>(key.begin(), key.begin() + 2 + key[1]), key)}) {
    const auto refused = decoder->decode(packet);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidStream);
  }
  // None of them has left anything behind.
  const auto next = decoder->decode(sized);
  ASSERT_TRUE(next);
  EXPECT_EQ(*next, coded[1].decoded);
}

TEST(PatternDecoder, AnInterFrameAloneIsInvalid) {
  const auto coded = sequence_of(pan(64, 64, 3), settings_of(40));
  EXPECT_EQ(PatternDecoder::create(64, 64)->decode(coded[1].av1).error().code, ErrorCode::kInvalidStream);
}

TEST(PatternDecoder, DamagedInterFramesAreErrorsOrPicturesOfTheRightSize) {
  const auto coded = sequence_of(pan(128, 96, 6), settings_of(30));
  std::mt19937 random(3);
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    auto decoder = PatternDecoder::create(128, 96);
    for (const SequencePattern& p : coded) {
      auto bytes = p.av1;
      if (random() % 2 == 0) bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
      if (random() % 8 == 0) bytes.resize(random() % bytes.size());
      const auto picture = decoder->decode(bytes);
      if (picture) {
        EXPECT_EQ(picture->width(), 128);
        EXPECT_EQ(picture->height(), 96);
      } else {
        ++refused;
        EXPECT_EQ(picture.error().code, ErrorCode::kInvalidStream) << picture.error().text;
      }
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(PatternDecoder, RecoversAtAKeyFrameAfterDamage) {
  const auto coded = sequence_of(pan(64, 64, 6), settings_of(40));
  std::mt19937 random(4);
  auto decoder = PatternDecoder::create(64, 64);
  for (int i = 0; i < 30; ++i) {
    auto junk = coded[1 + random() % 5].av1;
    for (int k = 0; k < 3; ++k) junk[random() % junk.size()] = static_cast<std::uint8_t>(random());
    (void)decoder->decode(junk);
    for (const SequencePattern& p : coded) {
      const auto back = decoder->decode(p.av1);
      ASSERT_TRUE(back) << back.error().text;
      EXPECT_EQ(*back, p.decoded);
    }
  }
}

}  // namespace
}  // namespace fbs
