#include "encoder/track/snake/feature_masks.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace fbs {
namespace {

const cv::Size kPatch(60, 50);

std::vector<cv::Point> mouth() {
  return {{20, 25}, {30, 20}, {40, 25}, {30, 30}};
}
std::vector<cv::Point> edge() {
  return {{15, 25}, {30, 22}, {45, 25}};
}

TEST(FeatureMasks, OfEveryFeatureDoNotOverlap) {
  for (const FeatureId id : {FeatureId::kMouthOuter, FeatureId::kBrowLeft, FeatureId::kUpperLidRight}) {
    const FeatureMasks m = feature_masks(id, id == FeatureId::kMouthOuter ? mouth() : edge(), kPatch);
    EXPECT_GT(cv::countNonZero(m.inside), 20);
    EXPECT_GT(cv::countNonZero(m.outside), 20);
    EXPECT_EQ(cv::countNonZero(m.inside & m.outside), 0) << feature(id).name;
  }
}

TEST(FeatureMasks, LipsAreInsideTheirOutline) {
  const FeatureMasks m = feature_masks(FeatureId::kMouthOuter, mouth(), kPatch);
  EXPECT_NE(m.inside.at<std::uint8_t>(25, 30), 0);
  EXPECT_NE(m.outside.at<std::uint8_t>(15, 30), 0) << "skin above them";
  EXPECT_EQ(m.outside.at<std::uint8_t>(19, 30), 0) << "the edge is neither";
}

TEST(FeatureMasks, InnerLipsAreABandRoundTheirLine) {
  const FeatureMasks m = feature_masks(FeatureId::kMouthInner, mouth(), kPatch);
  EXPECT_EQ(m.inside.at<std::uint8_t>(25, 30), 0) << "what lies between them";
  EXPECT_NE(m.inside.at<std::uint8_t>(32, 30), 0);
  EXPECT_TRUE(m.outside.empty());
}

TEST(FeatureMasks, LidsSkinIsAboveItsLashes) {
  const FeatureMasks m = feature_masks(FeatureId::kUpperLidLeft, edge(), kPatch);
  const cv::Moments lashes = cv::moments(m.inside, true), skin = cv::moments(m.outside, true);
  EXPECT_GT(lashes.m01 / lashes.m00, skin.m01 / skin.m00 + 2);
}

}  // namespace
}  // namespace fbs
