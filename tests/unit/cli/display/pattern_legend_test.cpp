#include "cli/display/pattern_legend.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "cli/display/pattern_tint.h"
#include "decoder/blend/picture_blend.h"

namespace fbs::cli {
namespace {

bool is(const cv::Vec3b& pixel, const Bgr& colour) {
  return pixel[0] == colour[0] && pixel[1] == colour[1] && pixel[2] == colour[2];
}

/// Pixels of the colour in an area.
int count(const cv::Mat& area, const Bgr& colour) {
  int found = 0;
  for (int y = 0; y < area.rows; ++y)
    for (int x = 0; x < area.cols; ++x) found += is(area.at<cv::Vec3b>(y, x), colour) ? 1 : 0;
  return found;
}

PictureSources sources_with_face(std::vector<PatternWeight> weights) {
  PictureSources sources;
  sources.in_slot = {0, 1};
  sources.arrived = 2;
  sources.regions.fill(std::move(weights));
  return sources;
}

TEST(PatternLegend, BarIsDividedAsTheWeightsAre) {
  const PictureSources sources =
      sources_with_face({{0, false, kBlendOne / 4}, {1, false, kBlendOne * 3 / 4}});
  const cv::Mat image = pattern_legend(sources, 0);
  for (const Region region : {Region::kMouth, Region::kGround}) {
    const cv::Rect rect = legend_bar(sources, region);
    const cv::Mat bar = image(rect);
    EXPECT_NEAR(count(bar, pattern_colour(0)), rect.area() / 4, rect.height);
    EXPECT_NEAR(count(bar, pattern_colour(1)), rect.area() * 3 / 4, rect.height);
    EXPECT_TRUE(is(bar.at<cv::Vec3b>(2, 1), pattern_colour(0))) << "in the order of numbers";
  }
}

TEST(PatternLegend, StillPatternsAreHatched) {
  const PictureSources warped = sources_with_face({{1, false, kBlendOne}}),
                       still = sources_with_face({{1, true, kBlendOne}});
  const cv::Rect bar = legend_bar(warped, Region::kHair);
  EXPECT_EQ(count(pattern_legend(warped, 0)(bar), pattern_colour(1)), bar.area());
  const int coloured = count(pattern_legend(still, 0)(bar), pattern_colour(1));
  EXPECT_LT(coloured, bar.area() * 9 / 10);
  EXPECT_GT(coloured, bar.area() / 3);
}

TEST(PatternLegend, WeightOfLessThanAPixelIsDrawn) {
  const PictureSources sources = sources_with_face({{0, true, 1}, {1, false, kBlendOne - 1}});
  const cv::Rect bar = legend_bar(sources, Region::kFace);
  EXPECT_GE(count(pattern_legend(sources, 0)(bar), pattern_colour(1)), bar.area() - bar.height);
}

TEST(PatternLegend, RegionsThatThePictureLacksAreNotShown) {
  PictureSources sources = sources_with_face({{1, false, kBlendOne}});
  sources.regions[static_cast<std::size_t>(Region::kFace)].clear();
  const cv::Mat image = pattern_legend(sources, 0);
  EXPECT_EQ(count(image(legend_bar(sources, Region::kFace)), pattern_colour(1)), 0);
  EXPECT_GT(count(image(legend_bar(sources, Region::kGround)), pattern_colour(1)), 0);
}

TEST(PatternLegend, IsAsHighAsWantedOrNeeded) {
  PictureSources sources = sources_with_face({{1, false, kBlendOne}});
  EXPECT_EQ(pattern_legend(sources, 2000).size(), cv::Size(kLegendWidth, 2000));
  EXPECT_LE(pattern_legend(sources, 0).rows, 576) << "fits beside an enlarged CIF picture";
  sources.in_slot.resize(kMaxPatterns);
  const cv::Rect last = legend_bar(sources, Region::kGround);
  EXPECT_GT(pattern_legend(sources, 0).rows, last.y + last.height);
}

}  // namespace
}  // namespace fbs::cli
