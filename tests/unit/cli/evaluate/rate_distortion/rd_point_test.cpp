#include "cli/evaluate/rate_distortion/rd_point.h"

#include <gtest/gtest.h>

namespace fbs::cli {
namespace {

TEST(RdPoint, QualityComesBackFromJson) {
  RdPoint point;
  point.pictures.resize(2);
  point.pictures[0].frame = {{1, 2}, {3, 4}, {5, 6}, 0.25, 0.5};
  point.pictures[1].face = AreaQuality{{7, 8}, {9, 10}, {11, 12}, 0.125, 0.75};
  point.vmaf = 61.5;
  RdPoint read;
  ASSERT_TRUE(read_quality(nlohmann::json::parse(quality_json(point).dump()), read));
  EXPECT_EQ(read.pictures, point.pictures);
  EXPECT_EQ(read.vmaf, point.vmaf);
}

TEST(RdPoint, OtherJsonChangesNothing) {
  RdPoint point;
  point.pictures.resize(3);
  for (const char* text : {"{}", "[]", R"({"pictures": [{"frame": [1, 2]}]})", R"({"pictures": [{}]})"})
    EXPECT_FALSE(read_quality(nlohmann::json::parse(text), point)) << text;
  EXPECT_EQ(point.pictures.size(), 3U);
}

TEST(RdPoint, RateIsThatOfAllBytes) {
  RdPoint point;
  point.bytes.total = 1000;
  EXPECT_EQ(point.kbps(), 0);
  point.seconds = 2;
  EXPECT_EQ(point.kbps(), 4);
}

}  // namespace
}  // namespace fbs::cli
