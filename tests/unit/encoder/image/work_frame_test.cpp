#include "encoder/image/work_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

TEST(WorkFrame, BringsEveryFaceToTheSameSize) {
  for (const double eye : {9.0, 24.0, 48.0, 200.0}) {
    const WorkFrame frame = WorkFrame::cut(Picture(640, 480), {300, 200}, eye, false);
    EXPECT_NEAR(frame.scale * eye, WorkFrame::kWorkEyeDistance, 0.05 * WorkFrame::kWorkEyeDistance) << eye;
    EXPECT_NEAR(frame.luma.cols / WorkFrame::kWorkEyeDistance, 4.2, 0.3);
    EXPECT_NEAR(frame.luma.rows / WorkFrame::kWorkEyeDistance, 5.0, 0.3);
  }
}

TEST(WorkFrame, PositionsGoToAndFro) {
  const WorkFrame frame = WorkFrame::cut(Picture(352, 288), {170, 120}, 31, false);
  for (const glm::dvec2 p : {glm::dvec2(0.5, 0.5), {170, 120}, {351.25, -20}}) {
    const glm::dvec2 back = frame.to_picture(frame.to_work(p));
    EXPECT_NEAR(back.x, p.x, 1e-9);
    EXPECT_NEAR(back.y, p.y, 1e-9);
  }
}

/// Where the brightness of a blob lies in a plane, in its samples.
glm::dvec2 centre_of_brightness(const cv::Mat& m) {
  glm::dvec2 sum(0);
  double weight = 0;
  for (int y = 0; y < m.rows; ++y) {
    for (int x = 0; x < m.cols; ++x) {
      const double v = m.at<std::uint8_t>(y, x);
      sum += v * glm::dvec2(x, y);
      weight += v;
    }
  }
  return sum / weight;
}

TEST(WorkFrame, ShowsThingsWhereItsPositionsSay) {
  for (const double eye : {12.0, 48.0, 90.0}) {
    const glm::dvec2 at(141.3, 122.8);
    // Whole pixels of the work frame scale the two axes a little differently.
    const double tolerance = std::max(0.2, 0.005 * eye);
    Picture picture(320, 240);
    for (auto& s : picture.u.samples) s = 0;
    const auto blob = [&](Plane& plane, double scale) {
      for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x) {
          const double dx = (x + 0.5) * scale - at.x, dy = (y + 0.5) * scale - at.y;
          plane.row(y)[x] = static_cast<std::uint8_t>(250 * std::exp(-(dx * dx + dy * dy) / 18));
        }
    };
    blob(picture.y, 1);
    blob(picture.u, 2);
    const WorkFrame frame = WorkFrame::cut(picture, {150, 118}, eye, true);
    ASSERT_EQ(frame.u.size(), frame.luma.size());
    for (const cv::Mat* m : {&frame.luma, &frame.u}) {
      const glm::dvec2 found = frame.to_picture(centre_of_brightness(*m));
      EXPECT_NEAR(found.x, at.x, tolerance) << eye;
      EXPECT_NEAR(found.y, at.y, tolerance) << eye;
    }
  }
}

TEST(WorkFrame, RepeatsTheBorderBeyondThePicture) {
  Picture picture(100, 80);
  for (auto& s : picture.y.samples) s = 90;
  for (const glm::dvec2 centre : {glm::dvec2(0, 0), {99, 79}, {-500, 4000}}) {
    const WorkFrame frame = WorkFrame::cut(picture, centre, 30, true);
    for (int y = 0; y < frame.luma.rows; y += 5)
      for (int x = 0; x < frame.luma.cols; x += 5) {
        const int v = frame.luma.at<std::uint8_t>(y, x);
        ASSERT_TRUE(v == 90 || v == 128) << v;
      }
  }
}

}  // namespace
}  // namespace fbs
