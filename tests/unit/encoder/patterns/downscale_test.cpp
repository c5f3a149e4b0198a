#include "encoder/patterns/downscale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "common/quality.h"
#include "decoder/pattern/upscale.h"
#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

TEST(Downscale, KeepsAConstant) {
  for (const int value : {0, 1, 128, 255})
    EXPECT_EQ(downscaled(Plane(39, 26, static_cast<std::uint8_t>(value))),
              Plane(20, 13, static_cast<std::uint8_t>(value)));
}

// <downscale(a), b> = <a, upscale(b)> / 4 away from borders, ranges' ends and but for rounding.
TEST(Downscale, IsTheUpscalerTransposed) {
  Plane full(48, 48, 100), reduced(24, 24, 100);
  full.row(23)[24] = 200;
  const Plane small = downscaled(full);
  for (int y = 6; y < 18; ++y)
    for (int x = 6; x < 18; ++x) {
      Plane one = reduced;
      one.row(y)[x] = 200;
      const int weight = upscaled(one, 48, 48).row(23)[24] - 100;
      EXPECT_NEAR(4 * (small.row(y)[x] - 100), weight, 3) << x << ',' << y;
    }
}

TEST(Downscale, ComesBackAlmostTheSame) {
  for (const auto& [w, h] : {std::pair{128, 96}, {97, 67}}) {
    const Picture picture = scenery(w, h);
    const Picture reduced = downscaled(picture);
    ASSERT_EQ(reduced.width(), (w + 1) / 2);
    ASSERT_EQ(reduced.u.height, (picture.u.height + 1) / 2);
    const Picture back = upscaled(reduced, w, h);
    EXPECT_GT(squared_error(picture.y, back.y).psnr(), 36);
    EXPECT_GT(squared_error(picture.u, back.u).psnr(), 42);
  }
}

}  // namespace
}  // namespace fbs
