#include "encoder/blend/mode_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace fbs {
namespace {

constexpr std::size_t kMouth = static_cast<std::size_t>(Region::kMouth);
constexpr BlendMode kOther = BlendMode::kHalfStill;

/// All modes cost the same.
std::vector<ModeErrors> even_errors(std::size_t pictures, double error) {
  ModeErrors all;
  for (auto& region : all) region.fill(error);
  return std::vector<ModeErrors>(pictures, all);
}

std::vector<ModeErrors> random_errors(std::size_t pictures) {
  std::mt19937 random(3);
  auto out = even_errors(pictures, 0);
  for (ModeErrors& picture : out)
    for (auto& region : picture)
      for (double& e : region) e = random() % 1000;
  return out;
}

TEST(ModeChoice, WithoutLambdaTakesTheLeastErrorOfEachPicture) {
  const auto errors = random_errors(40);
  const auto modes = cheapest_modes(errors, 0);
  ASSERT_EQ(modes.size(), errors.size());
  for (std::size_t t = 0; t < errors.size(); ++t)
    for (std::size_t r = 0; r < kRegionCount; ++r)
      EXPECT_EQ(errors[t][r][static_cast<std::size_t>(modes[t][r])],
                *std::min_element(errors[t][r].begin(), errors[t][r].end()));
}

TEST(ModeChoice, LargeLambdaNeverChanges) {
  for (const RegionModes& modes : cheapest_modes(random_errors(40), 1e6)) EXPECT_EQ(modes, RegionModes{});
}

/// Number of pictures in kOther when it is better for the mouth by `gain` in each of pictures 20..20 + length
/// - 1.
std::size_t pictures_in_other(int length, double gain, double lambda) {
  auto errors = even_errors(60, 1000);
  for (int t = 20; t < 20 + length; ++t) errors[t][kMouth][static_cast<std::size_t>(kOther)] -= gain;
  std::size_t count = 0;
  const auto modes = cheapest_modes(errors, lambda);
  for (std::size_t t = 0; t < modes.size(); ++t) {
    if (modes[t][kMouth] == kOther) ++count;
    for (std::size_t r = kMouth + 1; r < kRegionCount; ++r) EXPECT_EQ(modes[t][r], BlendMode::kByState);
  }
  return count;
}

TEST(ModeChoice, ChangesForAGainThatLastsAndNotForAShortOne) {
  EXPECT_EQ(pictures_in_other(3, 10, 10), 0U) << "30 squared levels do not pay for a change";
  EXPECT_GE(pictures_in_other(20, 10, 10), 20U) << "200 do";
  EXPECT_GE(pictures_in_other(3, 100, 10), 3U);
  EXPECT_EQ(pictures_in_other(20, 10, 100), 0U);
}

TEST(ModeChoice, ALaterChangeIsWeighedAgainstStaying) {
  // Better for a while, then much worse: it must go back.
  auto errors = even_errors(60, 1000);
  for (int t = 10; t < 40; ++t) errors[t][kMouth][static_cast<std::size_t>(kOther)] = 900;
  for (int t = 40; t < 60; ++t) errors[t][kMouth][static_cast<std::size_t>(kOther)] = 1100;
  const auto modes = cheapest_modes(errors, 10);
  for (int t = 10; t < 40; ++t) EXPECT_EQ(modes[t][kMouth], kOther) << t;
  for (int t = 40; t < 60; ++t) EXPECT_NE(modes[t][kMouth], kOther) << t;
}

TEST(ModeChoice, NoPicturesHaveNoModes) {
  EXPECT_TRUE(cheapest_modes({}, 1).empty());
}

}  // namespace
}  // namespace fbs
