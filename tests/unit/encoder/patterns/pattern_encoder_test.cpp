// Patterns there and back: libaom writes, dav1d reads.
#include "encoder/patterns/pattern_encoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/quality.h"
#include "decoder/pattern/pattern_decoder.h"
#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

std::vector<std::uint8_t> coded(const Picture& picture, int quantiser = 25) {
  auto encoder = PatternEncoder::create(format_of(picture.width(), picture.height()), quantiser);
  EXPECT_TRUE(encoder);
  auto bytes = encoder->encode(picture);
  EXPECT_TRUE(bytes) << bytes.error().text;
  return *bytes;
}

double psnr(const Picture& a, const Picture& b) {
  SquaredError e = squared_error(a.y, b.y);
  e += squared_error(a.u, b.u);
  e += squared_error(a.v, b.v);
  return e.psnr();
}

TEST(PatternCoding, RoundTripsAnySizeAbove40Db) {
  for (const auto& [w, h] : {std::pair{64, 64}, {65, 67}, {127, 66}, {352, 288}}) {
    const Picture picture = scenery(w, h);
    auto decoder = PatternDecoder::create(w, h);
    ASSERT_TRUE(decoder);
    const auto back = decoder->decode(coded(picture));
    ASSERT_TRUE(back) << w << 'x' << h << ": " << back.error().text;
    EXPECT_EQ(back->width(), w);
    EXPECT_EQ(back->u.height, (h + 1) / 2);
    EXPECT_GT(psnr(picture, *back), 40) << w << 'x' << h;
  }
}

TEST(PatternCoding, FinerQuantiserCostsMoreAndShowsMore) {
  const Picture picture = scenery(176, 144);
  std::size_t bytes = 0;
  double quality = 0;
  for (const int quantiser : {60, 40, 20, 4}) {
    const auto av1 = coded(picture, quantiser);
    const double q = psnr(picture, *PatternDecoder::create(176, 144)->decode(av1));
    EXPECT_GT(av1.size(), bytes) << quantiser;
    EXPECT_GT(q, quality) << quantiser;
    bytes = av1.size();
    quality = q;
  }
}

TEST(PatternCoding, LaterPatternsArePredicted) {
  auto encoder = PatternEncoder::create(format_of(176, 144), 30);
  auto decoder = PatternDecoder::create(176, 144);
  const auto first = encoder->encode(scenery(176, 144));
  const auto second = encoder->encode(scenery(176, 144, 3));
  ASSERT_TRUE(first && second);
  EXPECT_LT(second->size(), first->size() * 2 / 3);
  ASSERT_TRUE(decoder->decode(*first));
  const auto back = decoder->decode(*second);
  ASSERT_TRUE(back);
  EXPECT_GT(psnr(scenery(176, 144, 3), *back), 36);
}

TEST(PatternCoding, RangeAndMatrixChangeNoSample) {
  const Picture picture = scenery(64, 64);
  VideoFormat f = format_of(64, 64);
  const Picture plain = *PatternDecoder::create(64, 64)->decode(coded(picture));
  for (const ColourRange range : {ColourRange::kLimited, ColourRange::kFull}) {
    for (const ColourMatrix matrix :
         {ColourMatrix::kUnspecified, ColourMatrix::kBt601, ColourMatrix::kBt709}) {
      f.range = range;
      f.matrix = matrix;
      const auto av1 = PatternEncoder::create(f, 25)->encode(picture);
      ASSERT_TRUE(av1);
      EXPECT_EQ(*PatternDecoder::create(64, 64)->decode(*av1), plain);
    }
  }
}

TEST(PatternCoding, AnotherSizeThanAnnouncedIsInvalid) {
  const auto av1 = coded(scenery(128, 96));
  for (const auto& [w, h] : {std::pair{127, 96}, {128, 95}, {64, 64}, {258, 192}, {256, 190}}) {
    const auto refused = PatternDecoder::create(w, h)->decode(av1);
    ASSERT_FALSE(refused) << w << 'x' << h;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidStream);
  }
}

TEST(PatternDecoder, NothingIsInvalid) {
  EXPECT_EQ(PatternDecoder::create(64, 64)->decode({}).error().code, ErrorCode::kInvalidStream);
}

TEST(PatternDecoder, DamagedDataIsAnErrorOrAPictureButNoCrash) {
  const auto good = coded(scenery(128, 96));
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    auto bytes = good;
    for (unsigned k = 1 + random() % 6; k > 0; --k)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (i % 4 == 0) bytes.resize(1 + random() % bytes.size());
    auto decoder = PatternDecoder::create(128, 96);
    const auto picture = decoder->decode(bytes);
    if (picture) {
      EXPECT_EQ(picture->width(), 128);
      EXPECT_EQ(picture->height(), 96);
    } else {
      ++refused;
      EXPECT_EQ(picture.error().code, ErrorCode::kInvalidStream) << picture.error().text;
    }
  }
  EXPECT_GT(refused, 50);
}

// What a decoder saw before must not decide what a key frame decodes to.
TEST(PatternDecoder, DecodesAfterDamage) {
  const Picture picture = scenery(64, 64);
  const auto good = coded(picture);
  const Picture expected = *PatternDecoder::create(64, 64)->decode(good);
  std::mt19937 random(2);
  auto decoder = PatternDecoder::create(64, 64);
  int recovered = 0;
  for (int i = 0; i < 50; ++i) {
    std::vector<std::uint8_t> junk(1 + random() % 100);
    for (auto& b : junk) b = static_cast<std::uint8_t>(random());
    (void)decoder->decode(junk);
    const auto back = decoder->decode(good);
    if (!back) continue;
    ++recovered;
    EXPECT_EQ(*back, expected);
  }
  EXPECT_EQ(recovered, 50);
}

TEST(PatternEncoder, PredictsLaterPatternsFromEarlierOnes) {
  auto encoder = PatternEncoder::create(format_of(96, 80), 30);
  ASSERT_TRUE(encoder);
  const auto first = encoder->encode(scenery(96, 80)), again = encoder->encode(scenery(96, 80));
  ASSERT_TRUE(first && again);
  EXPECT_LT(again->size(), first->size() / 4);
}

TEST(PatternEncoder, RefusesWhatIsOutOfRange) {
  EXPECT_EQ(PatternEncoder::create(format_of(64, 64), -1).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(PatternEncoder::create(format_of(64, 64), 64).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(PatternEncoder::create(format_of(64, 64), 30)->encode(Picture(64, 66)).error().code,
            ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace fbs
