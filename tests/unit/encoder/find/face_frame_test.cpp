#include "encoder/find/face_frame.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/find/painted_face.h"

namespace fbs {
namespace {

TEST(FaceFrame, PlacesAreEyeDistancesFromTheMiddleOfTheEyes) {
  const FaceFrame f = painted_face([](glm::dvec2 p) { return 128 + 20 * p.x + 30 * p.y; },
                                   [](glm::dvec2 p) { return 128 - 20 * p.x; });
  for (const glm::dvec2 p : {glm::dvec2(0), {0.5, 0.2}, {-1, 1.2}}) {
    EXPECT_NEAR(f.luma(p.x, p.y), 128 + 20 * p.x + 30 * p.y, 1);
    EXPECT_NEAR(f.red(p.x, p.y), 128 - 20 * p.x, 1.5);
  }
}

TEST(FaceFrame, GoesWithTiltedEyes) {
  const Picture picture(200, 200);
  const FaceFrame f(picture, {80, 80}, {100, 120});
  const glm::dvec2 right = f.to_picture({-0.5, 0}), down = f.to_picture({0, 1}) - f.to_picture({0, 0});
  EXPECT_NEAR(right.x, 80, 1e-9);
  EXPECT_NEAR(right.y, 80, 1e-9);
  EXPECT_NEAR(down.x, -40, 1e-9);
  EXPECT_NEAR(down.y, 20, 1e-9);
}

TEST(FaceFrame, AValleyIsDarkerThanAboveAndBelow) {
  const FaceFrame f = painted_face([](glm::dvec2 p) { return 180 - 60 * ridge(p.y - 1, 0.04); });
  EXPECT_GT(f.valley(0, 1, 0.12), 35);
  EXPECT_LT(f.valley(0, 1.12, 0.12), 0);
  EXPECT_NEAR(f.valley(0, 0.3, 0.1), 0, 0.5);
}

TEST(FaceFrame, RepeatsItsBorder) {
  const FaceFrame f = painted_face([](glm::dvec2 p) { return 128 + 20 * p.x; });
  EXPECT_EQ(f.luma(50, 0), f.luma(60, 0));
}

}  // namespace
}  // namespace fbs
