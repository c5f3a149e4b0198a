#include "encoder/track/snake/feature_map.h"

#include <gtest/gtest.h>

#include <random>

namespace fbs {
namespace {

/// A patch with the feature on the left, skin on the right, each with noise of its own.
struct TwoHalves {
  std::array<cv::Mat, 3> patch;
  cv::Mat left, right;

  TwoHalves(cv::Vec3d feature, cv::Vec3d skin, double noise) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, noise);
    left = cv::Mat::zeros(40, 60, CV_8UC1);
    right = left.clone();
    left(cv::Rect(0, 0, 30, 40)) = 255;
    right(cv::Rect(30, 0, 30, 40)) = 255;
    for (int k = 0; k < 3; ++k) {
      patch[k] = cv::Mat(40, 60, CV_8UC1);
      for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x)
          patch[k].at<std::uint8_t>(y, x) =
              cv::saturate_cast<std::uint8_t>((x < 30 ? feature : skin)[k] + normal(random));
    }
  }
};

TEST(FeatureMap, IsOneOnTheFeatureAndZeroRoundIt) {
  const TwoHalves halves({90, 110, 165}, {140, 112, 145}, 5);
  for (const bool luma_only : {false, true}) {
    const cv::Mat1f map =
        FeatureMap::discriminant(halves.patch, halves.left, halves.right, luma_only)(halves.patch);
    EXPECT_NEAR(cv::mean(map, halves.left)[0], 1, 0.1);
    EXPECT_NEAR(cv::mean(map, halves.right)[0], 0, 0.1);
  }
}

// Lips that are as bright as the skin around them are redder all the same.
TEST(FeatureMap, TellsByColourWhatBrightnessDoesNot) {
  const TwoHalves halves({120, 110, 165}, {120, 112, 145}, 4);
  const cv::Mat1f map =
      FeatureMap::discriminant(halves.patch, halves.left, halves.right, false)(halves.patch);
  EXPECT_GT(cv::mean(map, halves.left)[0] - cv::mean(map, halves.right)[0], 0.8);
}

TEST(FeatureMap, LikenessIsHighForTheFeaturesColourAlone) {
  const TwoHalves lips_and_teeth({100, 110, 165}, {215, 126, 130}, 4);
  const auto likeness = FeatureMap::likeness(lips_and_teeth.patch, lips_and_teeth.left);
  EXPECT_GT(cv::mean(likeness(lips_and_teeth.patch), lips_and_teeth.left)[0], 0.6);
  EXPECT_LT(cv::mean(likeness(lips_and_teeth.patch), lips_and_teeth.right)[0], 0.1);
  const TwoHalves lips_and_dark({100, 110, 165}, {30, 126, 130}, 4);
  EXPECT_LT(cv::mean(likeness(lips_and_dark.patch), lips_and_dark.right)[0], 0.1) << "dark is no lip either";
}

TEST(FeatureMap, EmptyMasksAndFlatPatchesAreHarmless) {
  const TwoHalves flat({120, 128, 128}, {120, 128, 128}, 0);
  const cv::Mat nothing = cv::Mat::zeros(40, 60, CV_8UC1);
  for (const FeatureMap& map :
       {FeatureMap::discriminant(flat.patch, nothing, nothing, false),
        FeatureMap::discriminant(flat.patch, flat.left, flat.right, false),
        FeatureMap::likeness(flat.patch, nothing), FeatureMap::likeness(flat.patch, flat.left)}) {
    const cv::Mat1f seen = map(flat.patch);
    ASSERT_EQ(seen.size(), flat.left.size());
    EXPECT_TRUE(cv::checkRange(seen));
  }
}

}  // namespace
}  // namespace fbs
