#include "encoder/surround/surround_observations.h"

#include <gtest/gtest.h>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

SurroundObservations observed(int width, int height) {
  VideoFormat format;
  format.width = width;
  format.height = height;
  SurroundObservations out(format);
  out.set_first(noise_picture(width, height, 1), toy_state(width / 2, height / 2));
  for (unsigned i = 0; i < 3; ++i) out.add(noise_picture(width, height, 2 + i), toy_state(10, i));
  return out;
}

std::size_t bytes_of(const SurroundObservations::Observation& o) {
  EXPECT_EQ(o.luma.u == nullptr ? 0 : o.luma.u->size, o.luma.total()) << "a view of the picture";
  return o.luma.total() * o.luma.elemSize();
}

// Twelve of the largest pictures are 1.2 GB; what is kept of them is 1.5 MB.
TEST(SurroundObservations, KeepOnlySmallPictures) {
  for (const auto& [width, height] : {std::pair{1920, 1080}, {720, 1280}, {361, 64}, {352, 288}}) {
    const SurroundObservations o = observed(width, height);
    EXPECT_LE(bytes_of(o.first()), 360U * 360U);
    ASSERT_EQ(o.later().size(), 3U);
    for (const auto& later : o.later()) {
      EXPECT_LE(bytes_of(later), 360U * 360U);
      EXPECT_EQ(later.luma.size(), o.first().luma.size());
      EXPECT_EQ(later.luma.cols, width / o.factor());
    }
  }
}

TEST(SurroundObservations, KeepTheStates) {
  const SurroundObservations o = observed(352, 288);
  EXPECT_EQ(o.first().state, toy_state(176, 144));
  for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(o.later()[i].state, toy_state(10, i));
}

TEST(SurroundObservations, OutliveThePictures) {
  VideoFormat format;
  format.width = format.height = 64;
  SurroundObservations o(format);
  {
    Picture picture(64, 64);
    picture.y = Plane(64, 64, 77);
    o.set_first(picture, {});
    picture.y = Plane(64, 64, 11);
  }
  EXPECT_EQ(o.first().luma.at<std::uint8_t>(5, 5), 77);
}

}  // namespace
}  // namespace fbs
