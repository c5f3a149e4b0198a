#include <gtest/gtest.h>

#include "cli/video/y4m/y4m.h"

namespace fbs {
namespace {

TEST(Y4mHeader, HasFewerBytesThanFfmpegTakes) {
  const VideoFormat largest{
      8192, 8192, {60000, 1001}, {128, 117}, ColourRange::kLimited, ColourMatrix::kBt709};
  EXPECT_LE(y4m_header(largest).size(), 95U);
}

TEST(Y4mHeader, UnknownAspectAndRateAreAccepted) {
  const auto header = parse_y4m_header("YUV4MPEG2 W100 H80 F0:0 Ip A0:0 C420jpeg XYSCSS=420JPEG");
  ASSERT_TRUE(header);
  EXPECT_EQ(header->format.frame_rate, (Rational{25, 1}));
  EXPECT_EQ(header->format.pixel_aspect, (Rational{0, 1}));
}

}  // namespace
}  // namespace fbs
