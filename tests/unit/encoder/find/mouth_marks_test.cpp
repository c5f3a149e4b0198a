#include "encoder/find/mouth_marks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoder/find/landmarks.h"
#include "tests/unit/encoder/find/painted_face.h"

namespace fbs {
namespace {

/// A closed mouth with its dark line at y, its corners `half` to either side, and nostrils where they belong.
FaceFrame mouth(double y, double half) {
  return painted_face(
      [=](glm::dvec2 p) {
        const double line = std::abs(p.x) < half ? 80 * ridge(p.y - y, 0.025) : 0;
        const double nostrils = std::abs(p.x) < 0.18 ? 60 * ridge(p.y - 0.565 * y, 0.03) : 0;
        return 180 - line - nostrils;
      },
      [=](glm::dvec2 p) {
        const bool lips = std::abs(p.x) < half && p.y > y - 0.13 && p.y < y + 0.19;
        return lips ? 146.0 : 132.0;
      });
}

TEST(MouthMarks, FindLineAndCorners) {
  for (const double y : {1.0, 1.12, 1.25}) {
    const MouthMarks m = find_mouth(mouth(y, 0.42), {});
    EXPECT_NEAR(m.line, y, 0.05) << y;
    EXPECT_NEAR(m.right.y, y, 0.08);
    EXPECT_NEAR(m.left.y, y, 0.08);
    EXPECT_NEAR(m.right.x, -0.4, 0.05);
    EXPECT_NEAR(m.left.x, 0.4, 0.05);
  }
}

TEST(MouthMarks, AWiderMouthHasItsCornersFartherOut) {
  const MouthMarks wide = find_mouth(mouth(1.12, 0.52), {}), narrow = find_mouth(mouth(1.12, 0.33), {});
  EXPECT_GT(wide.left.x - wide.right.x, narrow.left.x - narrow.right.x + 0.08);
}

TEST(MouthMarks, PlaceTheLandmarksOnTheirBorders) {
  MouthMarks m;
  m.lips = {0.95, 1.05, 1.25, 1.4};
  m.line = 1.15;
  m.right = {-0.45, 1.2};
  m.left = {0.4, 1.1};
  const auto expect_at = [&](int landmark, glm::dvec2 p, double tolerance) {
    EXPECT_NEAR(m.place_of(landmark).x, p.x, tolerance) << landmark;
    EXPECT_NEAR(m.place_of(landmark).y, p.y, tolerance) << landmark;
  };
  expect_at(ibug::kMouthRight, m.right, 1e-9);
  expect_at(ibug::kMouthLeft, m.left, 0.02);
  const double middle = 0.5 * (m.right.x + m.left.x);
  expect_at(ibug::kUpperLipTop, {middle, m.lips.top}, 0.02);
  expect_at(ibug::kUpperLipInner, {middle, m.lips.inner_top}, 0.02);
  expect_at(ibug::kLowerLipInner, {middle, m.lips.inner_bottom}, 0.02);
  expect_at(ibug::kLowerLipBottom, {middle, m.lips.bottom}, 0.02);
}

}  // namespace
}  // namespace fbs
