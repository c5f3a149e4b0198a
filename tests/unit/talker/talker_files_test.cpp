#include "tests/talker/talker_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "tests/unit/talker/small_clip.h"

namespace fbs::talker {
namespace {

TEST(TalkerFiles, Y4mHasHeaderAndWholeFrames) {
  Settings settings = small();
  settings.width = 97;  // odd sizes round chroma up
  settings.frame_rate = {30000, 1001};
  std::ostringstream out;
  write_y4m_header(out, settings);
  const std::string header = out.str();
  EXPECT_TRUE(header.starts_with("YUV4MPEG2 W97 H80 F30000:1001 Ip A1:1 C420jpeg")) << header;
  EXPECT_TRUE(header.ends_with("\n"));
  write_y4m_frame(out, Talker(settings).picture(0));
  EXPECT_EQ(out.str().size(), header.size() + 6 + 97 * 80 + 2 * 49 * 40);
}

TEST(TalkerFiles, TruthHasAValueForEachColumn) {
  std::ostringstream header, line;
  write_truth_header(header);
  write_truth_line(line, Talker(small()), 5);
  EXPECT_TRUE(header.str().starts_with("frame,rx_deg,ry_deg,rz_deg,tx_px,ty_px,scale,x0,y0,x1,y1,"));
  EXPECT_TRUE(line.str().starts_with("5,"));
  const auto commas = [](const std::string& s) { return std::ranges::count(s, ','); };
  EXPECT_EQ(commas(header.str()), commas(line.str()));
}

}  // namespace
}  // namespace fbs::talker
