#include "encoder/shots/fade_in.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "encoder/shots/cut_detector.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

/// Its thumbnail in another light.
cv::Mat1f lit(const Picture& picture, double gain) {
  Picture out = picture;
  for (auto& s : out.y.samples) s = static_cast<std::uint8_t>(std::clamp(16 + gain * (s - 16.0), 0.0, 255.0));
  return CutDetector::thumbnail(out);
}

/// A picture of somebody who talks.
const Picture& talking(int frame) {
  static TalkerClip clip(talker_settings(176, 144, 1));
  return clip[frame];
}

/// Numbers of the pictures at which a fade ends; `light` gives the light of each.
template <class Light>
std::vector<int> ends(int count, Light&& light) {
  FadeIn fade_in;
  std::vector<int> out;
  for (int t = 0; t < count; ++t)
    if (fade_in.has_ended(lit(talking(t), light(t)))) out.push_back(t);
  return out;
}

TEST(FadeIn, EndsSoonAfterTheLightHasCome) {
  for (const int length : {6, 12, 45, 90}) {
    const auto found =
        ends(150, [&](int t) { return std::min(1.0, 0.05 + static_cast<double>(t) / length); });
    ASSERT_EQ(found.size(), 1U) << length;
    EXPECT_GE(found[0], length * 0.9);
    EXPECT_LE(found[0], length + 8);
  }
}

TEST(FadeIn, RisesUntilItEnds) {
  FadeIn fade_in;
  bool rose = false;
  for (int t = 0; t < 60; ++t) {
    const bool ended = fade_in.has_ended(lit(talking(t), std::min(1.0, 0.05 + t / 40.0)));
    if (ended || t > 50) {
      EXPECT_FALSE(fade_in.is_rising()) << t;
    } else if (t >= 10 && t < 38) {
      EXPECT_TRUE(fade_in.is_rising()) << t;
    }
    rose = rose || ended;
  }
  EXPECT_TRUE(rose);
}

TEST(FadeIn, BeginsInTheDark) {
  const auto found = ends(80, [](int t) { return std::clamp((t - 30) / 20.0, 0.0, 1.0); });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0], 54, 5);
}

TEST(FadeIn, SteadyLightIsNone) {
  EXPECT_TRUE(ends(150, [](int) { return 1.0; }).empty());
}

TEST(FadeIn, LessLightOrLittleMoreIsNone) {
  EXPECT_TRUE(ends(120, [](int t) { return std::max(0.1, 1 - t / 60.0); }).empty());
  EXPECT_TRUE(ends(120, [](int t) { return std::min(1.0, 0.8 + t / 60.0); }).empty());
}

// Patterns coded in the light are still there.
TEST(FadeIn, LightThatComesBackIsNone) {
  EXPECT_TRUE(ends(120, [](int t) { return t < 40 || t > 80 ? 1.0 : 0.3; }).empty());
}

TEST(FadeIn, ABeginAsksForMuchMoreThanThere) {
  FadeIn fade_in;
  for (int t = 0; t < 60; ++t) {
    if (t == 20) fade_in.begin();
    EXPECT_FALSE(fade_in.has_ended(lit(talking(t), t < 15 ? 0.2 : 1.0)) && t >= 20) << t;
  }
}

}  // namespace
}  // namespace fbs
