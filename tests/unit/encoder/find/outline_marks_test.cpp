#include "encoder/find/outline_marks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoder/find/landmarks.h"
#include "tests/unit/encoder/find/painted_face.h"

namespace fbs {
namespace {

/// Skin as wide as the generic face times `wide` down to a chin, before a dark wall.
FaceFrame face(double wide, double chin_y) {
  return painted_face([=](glm::dvec2 p) {
    double border = 0;
    for (const int k : {1, 2, 3, 4, 5}) {
      const glm::dvec3 a = generic_landmark(mirrored_jaw(k - 1)), b = generic_landmark(mirrored_jaw(k));
      if (p.y >= a.y && p.y < b.y) border = a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
    }
    if (p.y < generic_landmark(0).y) border = generic_landmark(16).x;
    const double lower = generic_landmark(mirrored_jaw(5)).y;
    if (p.y >= lower) border = generic_landmark(mirrored_jaw(5)).x;
    return std::abs(p.x) < wide * border && p.y < chin_y ? 170.0 : 60.0;
  });
}

MouthMarks closed_mouth() {
  MouthMarks m;
  m.lips = {1.0, 1.12, 1.12, 1.3};
  return m;
}

TEST(OutlineMarks, FindWiderAndNarrowerFaces) {
  const JawMarks narrow = find_jaw(face(0.9, 1.77), {}, closed_mouth()),
                 wide = find_jaw(face(1.1, 1.77), {}, closed_mouth());
  EXPECT_GT(wide.left, narrow.left + 0.05);
  EXPECT_GT(wide.right, narrow.right + 0.05);
}

// Its evidence is as wide as kChinReach either way, and the mouth decides within.
TEST(OutlineMarks, FindTheChinNearWhereTheMouthHasIt) {
  double before = 0;
  for (const double chin : {1.68, 1.77, 1.88}) {
    const double found = find_jaw(face(1, chin), {}, closed_mouth()).place_of(ibug::kChin, {}).y;
    EXPECT_NEAR(found, chin, 0.07);
    EXPECT_GT(found, before);
    before = found;
  }
}

TEST(OutlineMarks, AFlatPictureKeepsTheProportions) {
  const FaceFrame flat = painted_face([](glm::dvec2) { return 128.0; });
  const JawMarks jaw = find_jaw(flat, {}, closed_mouth());
  EXPECT_NEAR(jaw.left, 0, 0.02);
  EXPECT_NEAR(jaw.right, 0, 0.02);
  EXPECT_NEAR(jaw.place_of(ibug::kChin, {}).y, 1.12 + 0.65, 0.01);
}

TEST(JawMarks, StretchOnlyBelowTheEyes) {
  const JawMarks jaw{1.2, 0.1, -0.1};
  for (int k = ibug::kJawFirst; k < ibug::kJawEnd; ++k) {
    const glm::dvec3 g = generic_landmark(k);
    const glm::dvec2 p = jaw.place_of(k, {});
    EXPECT_NEAR(p.y, g.y < 0 ? g.y : 1.2 * g.y, 1e-12) << k;
    EXPECT_NEAR(p.x, g.x * (g.x < 0 ? 1.1 : 0.9), 1e-12) << k;
  }
}

}  // namespace
}  // namespace fbs
