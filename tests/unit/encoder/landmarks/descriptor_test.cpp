#include "encoder/landmarks/descriptor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "encoder/landmarks/face_patch.h"
#include "encoder/landmarks/landmark_search.h"
#include "encoder/landmarks/landmark_table.h"

namespace fbs {
namespace {

constexpr Look kLook = {64, 2, 5};

Shape mean() {
  static const Shape shape = load_landmarks()->mean;
  return shape;
}

std::vector<float> described(const cv::Mat1b& patch, const Shape& shape) {
  std::vector<float> out(kDescriptorSize);
  UprightView(patch, shape, mean(), kLook).describe(shape, out);
  return out;
}

/// Something with edges in all directions.
cv::Mat1b blobs() {
  cv::Mat1b out(kPatchSide, kPatchSide, std::uint8_t{90});
  for (int i = 0; i < 40; ++i)
    cv::circle(out, {(i * 61) % kPatchSide, (i * 97) % kPatchSide}, 8 + i % 13, cv::Scalar(40 + i * 5), -1);
  return out;
}

/// Contrast everywhere.
cv::Mat1b dots() {
  constexpr int kPitch = 16;
  cv::Mat1b out(kPatchSide, kPatchSide, std::uint8_t{20});
  for (int y = kPitch / 2; y < kPatchSide; y += kPitch)
    for (int x = kPitch / 2; x < kPatchSide; x += kPitch) cv::circle(out, {x, y}, 5, cv::Scalar(235), -1);
  return out;
}

float squares(const std::vector<float>& d, int landmark) {
  constexpr int kOf = kSpots * kOrientations;
  const auto first = d.begin() + static_cast<std::ptrdiff_t>(landmark) * kOf;
  return std::inner_product(first, first + kOf, first, 0.F);
}

TEST(Descriptor, OfALandmarkHasUnitLengthWhereThereIsContrast) {
  const auto d = described(dots(), LandmarkSearch::usual_shape(mean()));
  for (int k = 0; k < kLandmarkCount; ++k) EXPECT_NEAR(squares(d, k), 1, 0.3) << k;
}

TEST(Descriptor, OfAFlatPictureIsNothing) {
  const auto d =
      described(cv::Mat1b(kPatchSide, kPatchSide, std::uint8_t{120}), LandmarkSearch::usual_shape(mean()));
  for (const float v : d) ASSERT_EQ(v, 0);
}

TEST(Descriptor, DoesNotSeeBrightness) {
  const Shape shape = LandmarkSearch::usual_shape(mean());
  const auto a = described(blobs(), shape), b = described(blobs() * 0.8 + 20, shape);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 0.1) << i;
}

// The picture is seen upright, however the shape lies in it.
TEST(Descriptor, TurnsWithTheShape) {
  const Shape shape = LandmarkSearch::usual_shape(mean());
  const auto a = described(blobs(), shape);
  cv::Mat1b turned;
  cv::rotate(blobs(), turned, cv::ROTATE_90_CLOCKWISE);
  Shape turned_shape;
  for (std::size_t k = 0; k < shape.size(); ++k) turned_shape[k] = {kPatchSide - shape[k].y, shape[k].x};
  const auto b = described(turned, turned_shape);
  double off = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    off += (a[i] - b[i]) * (a[i] - b[i]);
    size += a[i] * a[i];
  }
  EXPECT_LT(off, 0.1 * size);
}

TEST(Descriptor, LandmarksOutsideThePatchAreHarmless) {
  Shape far = LandmarkSearch::usual_shape(mean());
  for (glm::vec2& p : far) p += 1000.F;
  for (const float v : described(blobs(), far)) ASSERT_TRUE(std::isfinite(v));
}

}  // namespace
}  // namespace fbs
