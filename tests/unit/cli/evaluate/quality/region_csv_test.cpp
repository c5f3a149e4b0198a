#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "cli/evaluate/quality/face_regions.h"
#include "cli/evaluate/run/run_folder.h"

namespace fbs::cli {
namespace {

/// A table of landmarks in a file of its own.
class RegionCsv : public testing::Test {
 protected:
  /// @param infix  between the letter and the number of a column
  static std::string header(const std::string& before, const std::string& infix = "",
                            const std::string& gap = "") {
    std::string out = before;
    for (const char* axis : {"x", "y"})
      for (int k = 0; k < 68; ++k) out += "," + gap + axis + infix + std::to_string(k);
    return out + "\n";
  }
  /// 68 points on the border and in the middle of a square of 20 samples at left, 10, `known` of them.
  static std::string face(const std::string& before, int left, int known = 68) {
    std::string xs, ys;
    for (int k = 0; k < 68; ++k) {
      xs += k < known ? "," + std::to_string(left + (k % 4 < 2 ? 0 : 20)) + ".2" : ",nan";
      ys += k < known ? "," + std::to_string(10 + (k % 2 == 0 ? 0 : 20)) + ".0" : ",nan";
    }
    return before + xs + ys + "\n";
  }
  Result<FaceRegions> read(const std::string& text) {
    std::ofstream(run_->path("faces.csv")) << text;
    return read_region_csv(run_->path("faces.csv"));
  }

  Result<RunFolder> run_ = RunFolder::temporary();
};

TEST_F(RegionCsv, IsTheHullOfThePoints) {
  const auto regions = read(header("frame") + face("0", 5) + face("1", 7));
  ASSERT_TRUE(regions);
  ASSERT_EQ(regions->outlines.size(), 2U);
  EXPECT_EQ(regions->believed(), 2U);
  Plane mask(64, 48);
  const PixelBox box = draw_face(regions->of(1), mask);
  EXPECT_EQ(box.x, 7);
  EXPECT_EQ(box.y, 10);
  EXPECT_EQ(box.width, 21);
  EXPECT_EQ(box.height, 21);
  EXPECT_EQ(mask.row(20)[15], 255);
  EXPECT_EQ(mask.row(20)[5], 0);
}

TEST_F(RegionCsv, ReadsTablesOfOpenFace) {
  const auto regions =
      read(header("frame, face_id, timestamp, confidence, success", "_", " ") +
           face("1, 0, 0.0, 0.98, 1", 5) + face("2, 0, 0.04, 0.98, 0", 5) + face("3, 0, 0.08, 0.2, 1", 5) +
           face("4, 0, 0.12, 0.9, 1", 9) + face("4, 1, 0.12, 0.9, 1", 30));
  ASSERT_TRUE(regions) << regions.error().text;
  ASSERT_EQ(regions->outlines.size(), 4U);
  EXPECT_EQ(regions->believed(), 2U);
  EXPECT_FALSE(regions->of(0).empty());
  EXPECT_TRUE(regions->of(1).empty());
  EXPECT_TRUE(regions->of(2).empty());
  Plane mask(64, 48);
  EXPECT_EQ(draw_face(regions->of(3), mask).x, 9);
}

TEST_F(RegionCsv, FramesThatAreNotThereHaveNoFace) {
  const auto regions = read(header("frame") + face("0", 5) + face("3", 5));
  ASSERT_TRUE(regions);
  EXPECT_EQ(regions->outlines.size(), 4U);
  EXPECT_EQ(regions->believed(), 2U);
  EXPECT_TRUE(regions->of(99).empty());
}

TEST_F(RegionCsv, LeavesOutPointsThatAreNoNumber) {
  const auto regions = read(header("frame") + face("0", 5, 40) + face("1", 5, 29));
  ASSERT_TRUE(regions);
  EXPECT_FALSE(regions->of(0).empty());
  EXPECT_TRUE(regions->of(1).empty());
}

TEST_F(RegionCsv, SaysWhatIsWrong) {
  const auto says = [&](const std::string& text, const std::string& words) {
    const auto read_back = read(text);
    ASSERT_FALSE(read_back);
    EXPECT_NE(read_back.error().text.find(words), std::string::npos) << read_back.error().text;
    EXPECT_NE(read_back.error().text.find("faces.csv"), std::string::npos);
  };
  says("", "cannot read");
  says("frame,x0,y0\n0,1,2\n", "has no columns x0,y0");
  says(header("frame"), "has no line");
  says(header("frame") + face("0", 5) + "1,2,3\n", "line 3");
  says(header("frame") + face("-1", 5), "line 2");
  says(header("frame") + face("nan", 5), "line 2");
}

TEST_F(RegionCsv, HashChangesWithThePoints) {
  const auto a = read(header("frame") + face("0", 5)), b = read(header("frame") + face("0", 6));
  EXPECT_NE(a->hash(), b->hash());
}

}  // namespace
}  // namespace fbs::cli
