#include "encoder/patterns/first_pattern.h"

#include <gtest/gtest.h>

#include "common/quality.h"
#include "decoder/pattern/pattern_decoder.h"
#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

constexpr int kWidth = 96, kHeight = 80;

TEST(FirstPattern, GivesWhatADecoderOfItsBytesShows) {
  const Picture picture = scenery(kWidth, kHeight);
  const auto coded = FirstPattern(format_of(kWidth, kHeight), picture).take(30);
  auto decoder = PatternDecoder::create(kWidth, kHeight);
  ASSERT_TRUE(coded && decoder);
  const auto shown = decoder->decode(coded->av1);
  ASSERT_TRUE(shown);
  EXPECT_EQ(*shown, coded->decoded);
}

TEST(FirstPattern, TakesTheQuantiserAskedForWhateverWasTriedBefore) {
  const Picture picture = scenery(kWidth, kHeight);
  FirstPattern trials(format_of(kWidth, kHeight), picture);
  std::map<int, std::size_t> bytes;
  for (const int quantiser : {20, 40, 60, 40}) {
    const auto size = trials.bytes(quantiser);
    ASSERT_TRUE(size);
    bytes[quantiser] = *size;
  }
  EXPECT_GT(bytes[20], bytes[40]);
  EXPECT_GT(bytes[40], bytes[60]);
  for (const int quantiser : {40, 20}) {
    auto taken = trials.take(quantiser);
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->av1.size(), bytes[quantiser]);
    EXPECT_GT(squared_error(taken->decoded.y, picture.y).psnr(), 30);
  }
}

TEST(FirstPattern, PassesErrorsOn) {
  const Picture picture = scenery(kWidth, kHeight);
  FirstPattern trials(format_of(kWidth, kHeight), picture);
  EXPECT_FALSE(trials.bytes(64));
  EXPECT_FALSE(trials.take(-1));
  EXPECT_TRUE(trials.take(30));
}

TEST(FirstPattern, TheFinestThatFitsIsOneStepFromWhatDoesNot) {
  const Picture picture = scenery(kWidth, kHeight);
  FirstPattern trials(format_of(kWidth, kHeight), picture);
  const std::size_t most = *trials.bytes(40);
  const auto quantiser = trials.finest_within(most, 20);
  ASSERT_TRUE(quantiser);
  EXPECT_LE(*trials.bytes(*quantiser), most);
  EXPECT_GT(*trials.bytes(*quantiser - 1), most);
  EXPECT_EQ(trials.finest_within(most, 50), 50);
  EXPECT_EQ(trials.finest_within(1, 20), kMaxQuantiser);
}

TEST(StartPattern, IsCoarserAndThenOfHalfSize) {
  const Picture picture = scenery(kWidth, kHeight);
  const VideoFormat format = format_of(kWidth, kHeight);
  const std::size_t coarsest = *FirstPattern(format, picture, kTrialSpeed).bytes(kMaxQuantiser);
  for (const std::size_t most : {coarsest * 3, coarsest, coarsest - 1}) {
    const auto coded = code_start_pattern(format, picture, {}, most);
    ASSERT_TRUE(coded);
    EXPECT_LE(coded->av1.size(), most);
    EXPECT_GT(coded->av1.size(), most / 2);
    auto decoder = PatternDecoder::create(kWidth, kHeight);
    ASSERT_TRUE(decoder);
    const auto shown = decoder->decode_frame(coded->av1);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->picture, coded->decoded);
    EXPECT_EQ(shown->reduced, most < coarsest);
    EXPECT_GT(squared_error(coded->decoded.y, picture.y).psnr(), 30);
  }
}

TEST(StartPattern, IsNoFinerThanWanted) {
  const Picture picture = scenery(kWidth, kHeight);
  const VideoFormat format = format_of(kWidth, kHeight);
  const auto coded = code_start_pattern(format, picture, {30, false, kTrialSpeed}, 1000000);
  ASSERT_TRUE(coded);
  EXPECT_EQ(coded->av1.size(), FirstPattern(format, picture, kTrialSpeed).bytes(30));
  const auto reduced = code_start_pattern(format, picture, {30, true, kTrialSpeed}, 1);
  ASSERT_TRUE(reduced) << "as coarse as can be";
  EXPECT_GT(reduced->av1.size(), 1U);
}

}  // namespace
}  // namespace fbs
