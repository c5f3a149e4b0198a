#include "decoder/field/padded_plane.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(PaddedPlane, RepeatsWhatLiesInsideTheBorder) {
  for (const int inset : {0, 1, 2}) {
    const Plane plane = noise_plane(33, 17, 1);
    const PaddedPlane padded(plane, inset);
    for (int y = -kPlanePadding; y < 17 + kPlanePadding; ++y)
      for (int x = -kPlanePadding; x < 33 + kPlanePadding; ++x)
        ASSERT_EQ(*padded.at(x, y),
                  plane.row(std::clamp(y, inset, 16 - inset))[std::clamp(x, inset, 32 - inset)])
            << inset << ": " << x << ',' << y;
  }
}

TEST(PaddedPlane, OfAPictureDistrustsTwoLumaSamplesAndOneOfChroma) {
  const Picture picture = noise_picture(65, 64, 2);
  const PaddedPicture padded = fbs::padded(picture);
  EXPECT_EQ(*padded[0].at(0, 0), picture.y.row(2)[2]);
  EXPECT_EQ(*padded[0].at(64, 63), picture.y.row(61)[62]);
  EXPECT_EQ(*padded[1].at(-9, 0), picture.u.row(1)[1]);
  EXPECT_EQ(*padded[2].at(32, 31), picture.v.row(30)[31]);
  EXPECT_EQ(padded[1].stride(), padded[2].stride());
}

}  // namespace
}  // namespace fbs
