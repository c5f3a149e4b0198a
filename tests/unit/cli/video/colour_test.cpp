#include "cli/video/colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <tuple>

namespace fbs {
namespace {

/// A picture whose colours all lie inside RGB: smooth, of medium saturation.
Picture soft_picture(int width, int height) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.y.row(y)[x] = static_cast<std::uint8_t>(90 + (x + 2 * y) % 80);
  }
  for (int y = 0; y < picture.u.height; ++y) {
    for (int x = 0; x < picture.u.width; ++x) {
      picture.u.row(y)[x] = static_cast<std::uint8_t>(110 + (3 * x + y) % 36);
      picture.v.row(y)[x] = static_cast<std::uint8_t>(112 + (x + 5 * y) % 32);
    }
  }
  return picture;
}

int largest_difference(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  EXPECT_EQ(a.size(), b.size());
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

class ColourOfEachKind : public ::testing::TestWithParam<std::tuple<ColourRange, ColourMatrix>> {};

TEST_P(ColourOfEachKind, PictureToRgbAndBackStaysWithinTwoLevels) {
  const auto [range, matrix] = GetParam();
  for (const auto& [width, height] : {std::pair{64, 64}, std::pair{65, 64}, std::pair{67, 71}}) {
    const Picture before = soft_picture(width, height);
    const RgbImage rgb = rgb_from_picture(before, range, matrix);
    const Picture after = picture_from_rgb(rgb.samples, width, height, range, matrix);
    EXPECT_LE(largest_difference(before.y.samples, after.y.samples), 2);
    EXPECT_LE(largest_difference(before.u.samples, after.u.samples), 2);
    EXPECT_LE(largest_difference(before.v.samples, after.v.samples), 2);
  }
}

TEST_P(ColourOfEachKind, EvenlyColouredRgbAndBackStaysWithinTwoLevels) {
  const auto [range, matrix] = GetParam();
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::array colour{static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
                            static_cast<std::uint8_t>(random())};
    std::vector<std::uint8_t> before(3 * 64 * 64);
    for (std::size_t i = 0; i < before.size(); ++i) before[i] = colour[i % 3];
    const Picture picture = picture_from_rgb(before, 64, 64, range, matrix);
    EXPECT_LE(largest_difference(before, rgb_from_picture(picture, range, matrix).samples), 2);
  }
}

TEST_P(ColourOfEachKind, GreyHasNoChroma) {
  const auto [range, matrix] = GetParam();
  for (int level = 0; level < 256; level += 5) {
    const std::vector<std::uint8_t> grey(3 * 64 * 64, static_cast<std::uint8_t>(level));
    const Picture picture = picture_from_rgb(grey, 64, 64, range, matrix);
    EXPECT_EQ(picture.u, Plane(32, 32, 128));
    EXPECT_EQ(picture.v, Plane(32, 32, 128));
  }
}

INSTANTIATE_TEST_SUITE_P(Colour, ColourOfEachKind,
                         ::testing::Combine(::testing::Values(ColourRange::kLimited, ColourRange::kFull),
                                            ::testing::Values(ColourMatrix::kUnspecified,
                                                              ColourMatrix::kBt601, ColourMatrix::kBt709)));

TEST(Colour, BlackAndWhiteHaveTheLevelsOfTheirRange) {
  const std::vector<std::uint8_t> black(3 * 64 * 64, 0);
  const std::vector<std::uint8_t> white(3 * 64 * 64, 255);
  const auto luma = [](const std::vector<std::uint8_t>& rgb, ColourRange range) {
    return int{picture_from_rgb(rgb, 64, 64, range, ColourMatrix::kBt709).y.samples[0]};
  };
  EXPECT_EQ(luma(black, ColourRange::kLimited), 16);
  EXPECT_EQ(luma(white, ColourRange::kLimited), 235);
  EXPECT_EQ(luma(black, ColourRange::kFull), 0);
  EXPECT_EQ(luma(white, ColourRange::kFull), 255);
}

// The primaries in 8 bits by ITU-R BT.601 and BT.709: 16 + 219 Y', 128 + 224 C.
TEST(Colour, RedHasTheValuesOfTheRecommendations) {
  std::vector<std::uint8_t> red(3 * 64 * 64, 0);
  for (std::size_t i = 0; i < red.size(); i += 3) red[i] = 255;
  const Picture bt601 = picture_from_rgb(red, 64, 64, ColourRange::kLimited, ColourMatrix::kBt601);
  EXPECT_EQ(bt601.y.samples[0], 81);
  EXPECT_EQ(bt601.u.samples[0], 90);
  EXPECT_EQ(bt601.v.samples[0], 240);
  const Picture bt709 = picture_from_rgb(red, 64, 64, ColourRange::kLimited, ColourMatrix::kBt709);
  EXPECT_EQ(bt709.y.samples[0], 63);
  EXPECT_EQ(bt709.u.samples[0], 102);
  EXPECT_EQ(bt709.v.samples[0], 240);
}

TEST(Colour, BgrIsRgbWithRedAndBlueExchanged) {
  const Picture picture = soft_picture(65, 67);
  RgbImage rgb = rgb_from_picture(picture, ColourRange::kLimited, ColourMatrix::kBt709);
  const RgbImage bgr =
      rgb_from_picture(picture, ColourRange::kLimited, ColourMatrix::kBt709, ChannelOrder::kBgr);
  for (std::size_t i = 0; i < rgb.samples.size(); i += 3) std::swap(rgb.samples[i], rgb.samples[i + 2]);
  EXPECT_EQ(rgb.samples, bgr.samples);
  EXPECT_EQ(
      picture_from_rgb(bgr.samples, 65, 67, ColourRange::kLimited, ColourMatrix::kBt709, ChannelOrder::kBgr)
          .y,
      picture.y);
}

}  // namespace
}  // namespace fbs
