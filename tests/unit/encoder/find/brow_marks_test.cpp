#include "encoder/find/brow_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/encoder/find/painted_face.h"

namespace fbs {
namespace {

constexpr double kHalfWidth = 0.056;

/// The middle of the generic head's right brow at x, raised.
double brow_at(double x, double lift) {
  double least = 1e9, y = 0;
  for (int i = 0; i + 1 < ibug::kBrowPoints; ++i) {
    const glm::dvec3 a = generic_landmark(ibug::kBrowRight + i),
                     b = generic_landmark(ibug::kBrowRight + i + 1);
    const double t = std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0), d = std::abs(a.x + t * (b.x - a.x) - x);
    if (d < least) {
      least = d;
      y = a.y + t * (b.y - a.y);
    }
  }
  return y + kHalfWidth - lift;
}

TEST(BrowMarks, FollowTheDarkRidge) {
  for (const double lift : {-0.05, 0.0, 0.08}) {
    const FaceFrame f =
        painted_face([&](glm::dvec2 p) { return 180 - 80 * ridge(p.y - brow_at(p.x, lift), 0.035); });
    const auto brow = find_brow(f, {}, ibug::kBrowRight);
    for (int i = 0; i < ibug::kBrowPoints; ++i) {
      const glm::dvec3 usual = generic_landmark(ibug::kBrowRight + i);
      EXPECT_NEAR(brow[i].x, usual.x, 1e-9);
      EXPECT_NEAR(brow[i].y, usual.y - lift, 0.03) << i << ", raised by " << lift;
    }
  }
}

TEST(BrowMarks, AreUsualWhereNothingIsSeen) {
  const FaceFrame flat = painted_face([](glm::dvec2) { return 128.0; });
  for (const int first : {ibug::kBrowRight, ibug::kBrowLeft}) {
    const auto brow = find_brow(flat, {}, first);
    for (int i = 0; i < ibug::kBrowPoints; ++i)
      EXPECT_NEAR(brow[i].y, generic_landmark(first + i).y, 0.03) << first + i;
  }
}

}  // namespace
}  // namespace fbs
