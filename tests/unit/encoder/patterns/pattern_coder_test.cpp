#include "encoder/patterns/pattern_coder.h"

#include <gtest/gtest.h>

#include "common/quality.h"
#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

constexpr int kWidth = 96, kHeight = 80;

TEST(PatternCoder, GivesWhatADecoderOfItsBytesShows) {
  auto coder = PatternCoder::create(format_of(kWidth, kHeight), 30);
  auto decoder = PatternDecoder::create(kWidth, kHeight);
  ASSERT_TRUE(coder && decoder);
  for (int time = 0; time < 3; ++time) {
    const auto coded = coder->code(scenery(kWidth, kHeight, time));
    ASSERT_TRUE(coded) << coded.error().text;
    const auto shown = decoder->decode(coded->av1);
    ASSERT_TRUE(shown);
    EXPECT_EQ(*shown, coded->decoded) << time;
  }
}

TEST(PatternCoder, PredictsLaterPatternsFromEarlierOnes) {
  auto coder = PatternCoder::create(format_of(kWidth, kHeight), 30);
  ASSERT_TRUE(coder);
  const auto first = coder->code(scenery(kWidth, kHeight)), again = coder->code(scenery(kWidth, kHeight));
  ASSERT_TRUE(first && again);
  EXPECT_LT(again->av1.size(), first->av1.size() / 4);
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
    EXPECT_EQ(taken->pattern.av1.size(), bytes[quantiser]);
    EXPECT_GT(squared_error(taken->pattern.decoded.y, picture.y).psnr(), 30);
  }
}

TEST(FirstPattern, CoderGoesOnFromTheFirstPattern) {
  const Picture picture = scenery(kWidth, kHeight);
  FirstPattern trials(format_of(kWidth, kHeight), picture);
  auto taken = trials.take(30);
  ASSERT_TRUE(taken);
  const auto next = taken->coder.code(picture);
  ASSERT_TRUE(next);
  EXPECT_LT(next->av1.size(), taken->pattern.av1.size() / 4) << "an inter frame";
}

TEST(FirstPattern, PassesErrorsOn) {
  const Picture picture = scenery(kWidth, kHeight);
  FirstPattern trials(format_of(kWidth, kHeight), picture);
  EXPECT_FALSE(trials.bytes(64));
  EXPECT_FALSE(trials.take(-1));
  EXPECT_TRUE(trials.take(30));
}

}  // namespace
}  // namespace fbs
