#include "encoder/patterns/pattern_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/quality.h"
#include "decoder/obu.h"
#include "decoder/pattern_decoder.h"
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

TEST(PatternSequence, CodesEachPictureOnceAndTheFirstFirst) {
  for (const int count : {1, 2, 3, 5, 9, 16, 17, 18, 26, 33, 64}) {
    const auto pictures = pan(64, 64, count);
    const auto coded = sequence_of(pictures, settings_of(40));
    ASSERT_EQ(coded.size(), pictures.size());
    EXPECT_EQ(coded[0].picture, 0U);
    std::vector<int> times(pictures.size());
    for (const SequencePattern& p : coded) ++times[p.picture];
    EXPECT_EQ(std::ranges::count(times, 1), count);
  }
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

TEST(PatternSequence, LooksAhead) {
  const auto coded = sequence_of(pan(64, 64, 16), settings_of(40));
  EXPECT_FALSE(std::ranges::is_sorted(coded, {}, &SequencePattern::picture));
}

}  // namespace
}  // namespace fbs
