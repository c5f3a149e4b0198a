#include "encoder/find/lip_borders.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/find/painted_face.h"

namespace fbs {
namespace {

/// Bright skin, darker and redder lips; what an open mouth shows between them is dark.
FaceFrame mouth(const LipBorders& b) {
  const auto lip = [b](double y) {
    return (y > b.top && y < b.inner_top) || (y > b.inner_bottom && y < b.bottom);
  };
  return painted_face(
      [=](glm::dvec2 p) {
        if (lip(p.y)) return 110.0;
        return p.y > b.inner_top && p.y < b.inner_bottom ? 30.0 : 170.0;
      },
      [=](glm::dvec2 p) { return lip(p.y) ? 150.0 : 132.0; });
}

void expect_found(const LipBorders& wanted, double line) {
  const LipBorders found = find_lip_borders(mouth(wanted), 0, line);
  EXPECT_NEAR(found.top, wanted.top, 0.04);
  EXPECT_NEAR(found.inner_top, wanted.inner_top, 0.04);
  EXPECT_NEAR(found.inner_bottom, wanted.inner_bottom, 0.04);
  EXPECT_NEAR(found.bottom, wanted.bottom, 0.04);
}

TEST(LipBorders, OfAnOpenMouth) {
  expect_found({1.0, 1.13, 1.33, 1.5}, 1.2);
}

TEST(LipBorders, OfANearlyClosedMouth) {
  expect_found({0.98, 1.1, 1.13, 1.31}, 1.11);
}

TEST(LipBorders, AreInOrderAndUsualWhereNothingIsSeen) {
  const LipBorders b = find_lip_borders(painted_face([](glm::dvec2) { return 128.0; }), 0, 1.1);
  EXPECT_NEAR(b.inner_top - b.top, 0.13, 0.02);
  EXPECT_NEAR(b.bottom - b.inner_bottom, 0.19, 0.02);
  EXPECT_LT(b.inner_bottom - b.inner_top, 0.03);
}

}  // namespace
}  // namespace fbs
