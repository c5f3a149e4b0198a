#include "cli/evaluate/quality/picture_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fbs::cli {
namespace {

constexpr int kWidth = 64, kHeight = 48;
const FaceOutline kSquare{{10, 10}, {29, 10}, {29, 29}, {10, 29}};  // 20 x 20 samples

double psnr_of_difference(double d) {
  return 20 * std::log10(255 / d);
}

TEST(PictureQuality, HasEachPlaneAndTheFaceAlone) {
  const Picture source(kWidth, kHeight);
  Picture shown = source;
  for (int y = 10; y < 30; ++y)
    for (int x = 10; x < 30; ++x) shown.y.row(y)[x] = 4;
  for (std::uint8_t& v : shown.u.samples) v = 130;
  const PictureQuality q = compare_pictures(source, shown, kSquare);
  ASSERT_TRUE(q.face);
  EXPECT_EQ(q.face->y.count, 400U);
  EXPECT_NEAR(q.face->y.psnr(), psnr_of_difference(4), 1e-9);
  EXPECT_EQ(q.face->u.count, 100U);
  EXPECT_NEAR(q.face->u.psnr(), psnr_of_difference(2), 1e-9);
  EXPECT_EQ(q.face->v.psnr(), 99);
  EXPECT_EQ(q.frame.y.sum, 400U * 16);
  EXPECT_EQ(q.frame.y.count, static_cast<std::uint64_t>(kWidth * kHeight));
  EXPECT_LT(q.face->ssim, q.frame.ssim);
}

TEST(PictureQuality, HasNoFaceWithoutOneInThePicture) {
  const Picture p(kWidth, kHeight);
  EXPECT_FALSE(compare_pictures(p, p, {}).face);
  EXPECT_FALSE(compare_pictures(p, p, {{-30, -30}, {-10, -30}, {-20, -10}}).face);
}

TEST(PictureQuality, SumsErrorsAndTakesMeansOfSimilarity) {
  std::vector<PictureQuality> pictures(2);
  pictures[0].frame = {{100, 10}, {}, {}, 0.5, 0.7};
  pictures[1].frame = {{300, 10}, {}, {}, 0.7, 0.9};
  pictures[1].face = AreaQuality{{50, 5}, {}, {}, 0.4, 0.6};
  const QualitySummary sum = summarise(pictures);
  EXPECT_NEAR(sum.frame.y.psnr(), psnr_of_difference(std::sqrt(20)), 1e-9);
  EXPECT_NEAR(sum.frame.ssim, 0.6, 1e-12);
  EXPECT_NEAR(sum.frame.ms_ssim, 0.8, 1e-12);
  EXPECT_EQ(sum.face.pictures, 1U);
  EXPECT_NEAR(sum.face.ssim, 0.4, 1e-12);
}

}  // namespace
}  // namespace fbs::cli
