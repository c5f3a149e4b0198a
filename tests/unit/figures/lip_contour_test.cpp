// The paper's case for an energy of repulsion: "a mouth opened where the teeth are visible". Pictures are
// painted, and pass through the whole input of the lips' snake.
#include "tests/figures/lip_contour.h"

#include <gtest/gtest.h>

#include "tests/figures/painted_mouth.h"

namespace fbs {
namespace {

constexpr double kOpen = 0.4;       // eye distances; rarely exceeded in speech
constexpr double kTeeth = 0.9;      // of the gap; the rest is dark
constexpr double kUpperLip = 0.15;  // its height in the middle, eye distances

/// Heights of the contour, eye distances.
struct Heights {
  double closed = 0, opened = 0, closed_again = 0;
};

/// @param step  how much farther the mouth opens from one picture to the next, eye distances
Heights follow(double repulsion, double step, double open = kOpen) {
  const Pose pose = painted_pose();
  LipContour lips(painted_geometry(), pose, painted_mouth(0, kTeeth), repulsion);
  Heights h;
  h.closed = lips.height();
  for (int i = 1; i * step < open + step / 2; ++i) lips.track(painted_mouth(i * step, kTeeth), pose);
  for (int i = 0; i < 3; ++i) lips.track(painted_mouth(open, kTeeth), pose);
  h.opened = lips.height();
  for (int i = 0; i < 3; ++i) lips.track(painted_mouth(0, kTeeth), pose);
  h.closed_again = lips.height();
  return h;
}

TEST(LipContour, RestsOnTheClosedLips) {
  EXPECT_NEAR(follow(1, kOpen).closed, painted_height(0), 0.02);
}

TEST(LipContour, CollapsesOnTheUpperLipWithoutRepulsion) {
  EXPECT_LT(follow(0, kOpen).opened, kUpperLip + 0.02);
}

// Repulsion ends at 4/5 of the height at rest; the lower lip itself is out of sight.
TEST(LipContour, RepulsionKeepsItOpen) {
  const Heights h = follow(1, kOpen);
  EXPECT_GT(h.opened, 0.7 * h.closed);
  EXPECT_GT(h.opened, follow(0, kOpen).opened + 0.06);
}

TEST(LipContour, FindsTheLipsAgainWhenTheyClose) {
  const Heights h = follow(1, kOpen);
  EXPECT_NEAR(h.closed_again, h.closed, 0.02);
}

// Opened slowly, the contrast alone leads the contour: the term is not what moves it.
TEST(LipContour, FollowsASlowMouthWithAndWithoutRepulsion) {
  constexpr double kHalf = 0.3;  // as high again as the closed lips
  EXPECT_NEAR(follow(0, 0.03, kHalf).opened, painted_height(kHalf), 0.05);
  EXPECT_NEAR(follow(1, 0.03, kHalf).opened, painted_height(kHalf), 0.05);
}

}  // namespace
}  // namespace fbs
