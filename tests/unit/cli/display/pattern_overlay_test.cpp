#include "cli/display/pattern_overlay.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "cli/display/display_image.h"
#include "cli/display/pattern_legend.h"
#include "cli/display/pattern_tint.h"
#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs::cli {
namespace {

/// Two patterns in ten pictures; all regions of the first five show the one, all of the last the other.
Writer two_halves() {
  Writer w;
  w.setup(setup_of(2)).geometry().surround().pattern();
  w.motion(0, 10, true).pattern(face_picture(1), 1, 9);
  w.blend(5, BlendMode::kStillBefore).blend(5, BlendMode::kStillAfter);
  return w;
}

/// Which way the mean colour of an image departs from grey.
cv::Vec3d hue(const cv::Mat& image) {
  const cv::Scalar mean = cv::mean(image);
  const double grey = (mean[0] + mean[1] + mean[2]) / 3;
  return cv::normalize(cv::Vec3d(mean[0] - grey, mean[1] - grey, mean[2] - grey));
}

cv::Vec3d hue(const Bgr& c) {
  return hue(cv::Mat(1, 1, CV_8UC3, cv::Scalar(c[0], c[1], c[2])));
}

TEST(PatternOverlay, PictureIsTintedByThePatternsThatDrawIt) {
  StreamDecoder decoder = recording_decoder(two_halves());
  Picture picture;
  for (std::size_t t = 0; t < 9; ++t) {
    ASSERT_EQ(decoder.next(), DecodeStatus::kPicture);
    ASSERT_TRUE(decoder.render(picture));
    const cv::Mat image = display_image(picture, decoder.format());
    const auto overlaid = pattern_overlay(decoder, image);
    ASSERT_TRUE(overlaid);
    EXPECT_EQ(overlaid->cols, image.cols + kLegendWidth);
    EXPECT_GE(overlaid->rows, image.rows);
    const cv::Vec3d tint = hue((*overlaid)(cv::Rect({0, 0}, image.size())));
    EXPECT_GT(tint.dot(hue(pattern_colour(t < 5 ? 0 : 1))), 0.95) << t;
  }
}

TEST(PatternOverlay, NeitherTheImageNorTheDecoderChanges) {
  StreamDecoder decoder = recording_decoder(two_halves());
  ASSERT_EQ(decoder.next(), DecodeStatus::kPicture);
  Picture picture, again;
  ASSERT_TRUE(decoder.render(picture));
  const cv::Mat image = display_image(picture, decoder.format()), before = image.clone();
  const auto first = pattern_overlay(decoder, image), second = pattern_overlay(decoder, image);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(cv::norm(image, before, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(*first, *second, cv::NORM_INF), 0);
  ASSERT_TRUE(decoder.render(again));
  EXPECT_EQ(again, picture);
}

TEST(PatternOverlay, WithoutPatternsTheImageStaysAsItIs) {
  StreamDecoder decoder;
  const cv::Mat image(20, 30, CV_8UC3, cv::Scalar(1, 2, 3));
  const auto overlaid = pattern_overlay(decoder, image);
  ASSERT_TRUE(overlaid);
  EXPECT_EQ(overlaid->data, image.data);
}

}  // namespace
}  // namespace fbs::cli
