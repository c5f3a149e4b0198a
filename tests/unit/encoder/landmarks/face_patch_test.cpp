#include "encoder/landmarks/face_patch.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace fbs {
namespace {

/// Brightness says where in the picture a pixel is.
cv::Mat1b ramp(int width, int height) {
  cv::Mat1b out(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out(y, x) = static_cast<std::uint8_t>(x);
  return out;
}

TEST(FacePatch, BringsAFaceToTheSameSize) {
  for (const double eye : {16.0, 50.0, 128.0}) {
    const FacePatch patch(ramp(250, 200), {{125, 100}, eye});
    EXPECT_EQ(patch.luma().size(), cv::Size(kPatchSide, kPatchSide));
    const glm::vec2 a = patch.to_patch({125, 100}), b = patch.to_patch({125 + eye, 100});
    EXPECT_NEAR(b.x - a.x, kPatchEyeDistance, 0.02 * kPatchEyeDistance);
    EXPECT_NEAR(a.x, kPatchSide / 2.F, 0.6 * kPatchEyeDistance / eye + 0.1);
  }
}

TEST(FacePatch, PositionsLeadBack) {
  const FacePatch patch(ramp(250, 200), {{90.3, 77.7}, 31});
  const glm::dvec2 p(101.25, 60.5), back = patch.to_picture(patch.to_patch(p));
  EXPECT_NEAR(back.x, p.x, 1e-3);
  EXPECT_NEAR(back.y, p.y, 1e-3);
}

TEST(FacePatch, ShowsWhatThePictureShowsThere) {
  const cv::Mat1b picture = ramp(250, 200);
  for (const double eye : {16.0, 50.0}) {
    const FacePatch patch(picture, {{125, 100}, eye});
    const glm::dvec2 p = patch.to_picture({100.5F, 120.5F});
    EXPECT_NEAR(patch.luma()(120, 100), p.x - 0.5, 1.01) << eye;
  }
}

TEST(FacePatch, RepeatsThePicturesBorder) {
  const FacePatch patch(ramp(60, 60), {{30, 30}, 100});  // far larger than the picture
  EXPECT_EQ(patch.luma()(kPatchSide / 2, 0), 0);
  EXPECT_EQ(patch.luma()(kPatchSide / 2, kPatchSide - 1), 59);
}

TEST(FacePatch, PlaceOutsideThePictureIsHarmless) {
  for (const glm::dvec2 at : {glm::dvec2(-500, -500), {1000, 30}, {30, 1e6}}) {
    const FacePatch patch(ramp(60, 60), {at, 10});
    EXPECT_EQ(patch.luma().cols, kPatchSide);
  }
}

}  // namespace
}  // namespace fbs
