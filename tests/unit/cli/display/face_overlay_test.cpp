#include "cli/display/face_overlay.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/unit/toy_scene.h"

namespace fbs::cli {
namespace {

constexpr int kSide = 400;

/// Turned to its own left, 2^-16 turns.
ScreenVertices head(std::int32_t yaw) {
  State state = toy_state(kSide / 2, kSide / 2);
  state.pose[kYaw] = yaw;
  state.pose[kLogScale] = 7 * 4096;  // 128 pixels between the eyes
  return toy_scene(Picture(kSide, kSide)).geometry->project_vertices(state);
}

cv::Mat black() {
  return {kSide, kSide, CV_8UC3, cv::Scalar()};
}

int drawn_pixels(const cv::Mat& image) {
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return cv::countNonZero(grey);
}

cv::Mat wire_frame(const ScreenVertices& vertices) {
  cv::Mat image = black();
  draw_wire_frame(image, generic_head(), vertices, 1);
  return image;
}

/// Every edge, hidden or not.
cv::Mat all_edges(const ScreenVertices& vertices) {
  cv::Mat image = black();
  const auto at = [&](std::uint16_t v) { return cv::Point(vertices[v].x - 32, vertices[v].y - 32); };
  for (const HeadTriangle& t : generic_head().triangles)
    for (std::size_t i = 0; i < 3; ++i)
      cv::line(image, at(t[i]), at(t[(i + 1) % 3]), {255, 255, 255}, 1, cv::LINE_AA, 6);
  return image;
}

TEST(FaceOverlay, AllEdgesAreSeenFromTheFront) {
  const ScreenVertices front = head(0);
  EXPECT_GT(drawn_pixels(wire_frame(front)), 0.9 * drawn_pixels(all_edges(front)));
}

TEST(FaceOverlay, EdgesBehindTheFaceAreNot) {
  const ScreenVertices side = head(65536 / 6);
  EXPECT_LT(drawn_pixels(wire_frame(side)), 0.9 * drawn_pixels(all_edges(side)));
}

TEST(FaceOverlay, ZoomedDrawingIsTheSameEnlarged) {
  cv::Mat large(2 * kSide, 2 * kSide, CV_8UC3, cv::Scalar());
  draw_wire_frame(large, generic_head(), head(0), 2);
  const auto box = [](const cv::Mat& image) {
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    return cv::boundingRect(grey);
  };
  const cv::Rect small = box(wire_frame(head(0))), big = box(large);
  EXPECT_NEAR(big.x, 2 * small.x, 3);
  EXPECT_NEAR(big.height, 2 * small.height, 5);
}

TEST(FaceOverlay, ContoursPassThroughTheirMarks) {
  const ScreenVertices front = head(0);
  cv::Mat image = black();
  draw_contours(image, generic_head(), front, 1);
  for (const std::size_t mark : {48, 51, 54, 57, 62, 66, 17, 19, 24, 26, 36, 38, 41, 45, 47}) {
    const glm::ivec3 p = front[vertex_of_landmark(mark)];
    const cv::Rect near((p.x >> 6) - 2, (p.y >> 6) - 2, 5, 5);
    EXPECT_GT(drawn_pixels(image(near)), 0) << mark;
  }
  const glm::ivec3 nose = front[vertex_of_landmark(30)];
  EXPECT_EQ(drawn_pixels(image(cv::Rect((nose.x >> 6) - 2, (nose.y >> 6) - 2, 5, 5))), 0);
}

}  // namespace
}  // namespace fbs::cli
