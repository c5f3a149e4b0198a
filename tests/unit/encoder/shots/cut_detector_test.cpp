#include "encoder/shots/cut_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

Picture plain(int level) {
  Picture p(176, 144);
  std::ranges::fill(p.y.samples, static_cast<std::uint8_t>(level));
  return p;
}

/// Smooth blobs, other ones for each seed.
Picture scenery(unsigned seed) {
  std::mt19937 random(seed);
  Picture p(176, 144);
  std::array<std::array<double, 4>, 12> waves{};
  for (auto& wave : waves)
    for (double& number : wave) number = static_cast<double>(random() % 1000) / 1000;
  for (int y = 0; y < p.height(); ++y)
    for (int x = 0; x < p.width(); ++x) {
      double sum = 128;
      for (const auto& w : waves)
        sum += 14 * std::sin((w[0] - 0.5) * x / 2 + (w[1] - 0.5) * y / 2 + 6.3 * w[2]);
      p.y.row(y)[x] = static_cast<std::uint8_t>(std::clamp(sum, 0.0, 255.0));
    }
  return p;
}

Picture lit(const Picture& picture, double gain, double offset) {
  Picture out = picture;
  for (auto& s : out.y.samples) s = static_cast<std::uint8_t>(std::clamp(gain * s + offset, 0.0, 255.0));
  return out;
}

Picture moved(const Picture& picture, int by) {
  Picture out = picture;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      out.y.row(y)[x] = picture.y.row(y)[std::clamp(x - by, 0, picture.width() - 1)];
  return out;
}

/// Whether the second picture is a cut from the first.
bool cut(const Picture& before, const Picture& now) {
  CutDetector cuts;
  EXPECT_FALSE(cuts.is_cut(before)) << "the first picture begins no other shot";
  return cuts.is_cut(now);
}

TEST(CutDetector, AnotherSceneIsACut) {
  TalkerClip clip(talker_settings(176, 144, 1));
  for (unsigned seed = 1; seed < 6; ++seed) {
    EXPECT_TRUE(cut(clip[0], scenery(seed))) << seed;
    EXPECT_TRUE(cut(scenery(seed), clip[0])) << seed;
    EXPECT_TRUE(cut(scenery(seed), scenery(seed + 10))) << seed;
  }
}

TEST(CutDetector, ATalkerIsOneShot) {
  TalkerClip clip(talker_settings(176, 144, 60));
  CutDetector cuts;
  for (int t = 0; t < clip.count(); ++t) EXPECT_FALSE(cuts.is_cut(clip[t])) << t;
}

TEST(CutDetector, MotionAndLightAreNoCuts) {
  const Picture p = scenery(3);
  EXPECT_FALSE(cut(p, moved(p, 15)));
  EXPECT_FALSE(cut(p, lit(p, 0.5, 20)));
  EXPECT_FALSE(cut(p, lit(p, 1, 40)));
}

TEST(CutDetector, WhatIsCoveredIsStillThere) {
  const Picture p = scenery(4);
  Picture covered = p;
  for (int y = 50; y < 120; ++y) std::fill_n(covered.y.row(y) + 60, 60, std::uint8_t{90});
  EXPECT_FALSE(cut(p, covered));
  EXPECT_FALSE(cut(covered, p));
}

TEST(CutDetector, BlackIsACutButNotAFade) {
  const Picture p = scenery(5);
  EXPECT_TRUE(cut(p, plain(16)));
  EXPECT_TRUE(cut(plain(16), p));
  EXPECT_FALSE(cut(plain(16), plain(20)));
  CutDetector cuts;
  for (int t = 0; t <= 12; ++t) EXPECT_FALSE(cuts.is_cut(lit(p, t / 12.0, 0))) << t;
}

}  // namespace
}  // namespace fbs
