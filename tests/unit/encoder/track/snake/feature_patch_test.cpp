#include "encoder/track/snake/feature_patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoder/track/snake/snake_kinds.h"

namespace fbs {
namespace {

/// Luma rises to the right and chroma downwards; the eyes are 40 pixels apart.
WorkFrame gradients() {
  Picture picture(160, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 160; ++x) picture.y.row(y)[x] = static_cast<std::uint8_t>(20 + x);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 80; ++x) picture.u.row(y)[x] = static_cast<std::uint8_t>(20 + 2 * y);
  return WorkFrame::cut(picture, {80, 50}, 40, true);
}

Pose pose() {
  Pose p;
  p.shift = {80, 50};
  p.log2_scale = std::log2(40.0);
  return p;
}

TEST(FeaturePatch, ShowsItsRegion) {
  const PatchPlane plane{{-8, 16, 20, 12}, 0};  // snake units, 32 to the 40 pixels
  const FeaturePatch patch = cut_patch(gradients(), pose(), plane, false);
  ASSERT_EQ(patch[0].size(), cv::Size(30, 18));
  const double px_per_unit = 40 / 32.0;
  for (const int x : {0, 12, 29})
    EXPECT_NEAR(patch[0].at<std::uint8_t>(9, x),
                20 + 80 + (plane.region.x + x / kPatchPxPerUnit) * px_per_unit - 0.5, 1.5);
  for (const int y : {0, 9, 17})
    EXPECT_NEAR(patch[1].at<std::uint8_t>(y, 5),
                20 + 50 + (plane.region.y + y / kPatchPxPerUnit) * px_per_unit - 0.5, 2.5);
}

TEST(FeaturePatch, LumaAloneIsTheSameLuma) {
  const PatchPlane plane{{-8, -20, 20, 12}, 500};
  const FeaturePatch all = cut_patch(gradients(), pose(), plane, false),
                     luma = cut_patch(gradients(), pose(), plane, true);
  EXPECT_EQ(cv::countNonZero(all[0] != luma[0]), 0);
  EXPECT_TRUE(luma[1].empty() && luma[2].empty());
}

// Far outside, the border is repeated.
TEST(FeaturePatch, HeadOutsideThePictureIsHarmless) {
  Pose away = pose();
  away.shift = {-4000, 9000};
  EXPECT_EQ(cut_patch(gradients(), away, {{-8, -20, 20, 12}, 0}, false)[2].size(), cv::Size(30, 18));
}

}  // namespace
}  // namespace fbs
