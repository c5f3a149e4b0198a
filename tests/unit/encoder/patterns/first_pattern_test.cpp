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

}  // namespace
}  // namespace fbs
