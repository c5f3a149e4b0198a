#include "cli/display/display_image.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace fbs::cli {
namespace {

VideoFormat sized(int width, int height) {
  VideoFormat format;
  format.width = width;
  format.height = height;
  return format;
}

TEST(DisplayImage, SmallPicturesAreEnlargedLargeOnesAreNot) {
  EXPECT_EQ(display_zoom(sized(64, 64)), 4);
  EXPECT_EQ(display_zoom(sized(176, 144)), 4);
  EXPECT_EQ(display_zoom(sized(352, 288)), 2);
  EXPECT_EQ(display_zoom(sized(720, 1280)), 1);
}

TEST(DisplayImage, IsTheEnlargedPictureInBlueGreenRed) {
  const VideoFormat format = sized(176, 144);
  Picture picture(format.width, format.height);
  picture.y = Plane(176, 144, 100);
  picture.v = Plane(88, 72, 200);
  const cv::Mat image = display_image(picture, format);
  EXPECT_EQ(image.size(), cv::Size(704, 576));
  const cv::Scalar mean = cv::mean(image);
  EXPECT_GT(mean[2], mean[0] + 50);
}

}  // namespace
}  // namespace fbs::cli
