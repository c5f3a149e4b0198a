#include "encoder/plan/operating_point.h"

#include <gtest/gtest.h>

#include "bitstream/payload/setup_payload.h"

namespace fbs {
namespace {

TEST(OperatingPoint, MovesEverythingTheSameWayWithQuality) {
  for (const double eye : {10.0, 34.0, 80.0, 400.0}) {
    for (int quality = 1; quality <= 100; ++quality) {
      const OperatingPoint worse = OperatingPoint::at(quality - 1, eye),
                           better = OperatingPoint::at(quality, eye);
      EXPECT_LE(better.pattern_quantiser, worse.pattern_quantiser);
      EXPECT_LE(better.steps.rotation, worse.steps.rotation);
      EXPECT_LE(better.steps.translation, worse.steps.translation);
      EXPECT_LE(better.steps.log_scale, worse.steps.log_scale);
      EXPECT_LE(better.steps.light, worse.steps.light);
      EXPECT_LE(better.steps.control, worse.steps.control);
      EXPECT_LT(better.lambda, worse.lambda);
    }
  }
}

TEST(OperatingPoint, IsAlwaysCodable) {
  for (const double eye : {1.0, 4.0, 60.0, 3000.0}) {
    for (int quality = 0; quality <= 100; quality += 5) {
      const OperatingPoint p = OperatingPoint::at(quality, eye);
      fbs::Setup setup;
      setup.format.width = setup.format.height = 64;
      setup.steps = p.steps;
      EXPECT_TRUE(check_setup(setup)) << quality << ' ' << eye;
      EXPECT_TRUE(p.pattern_quantiser >= 0 && p.pattern_quantiser <= 63);
      EXPECT_GT(p.lambda, 0);
    }
  }
}

// One step of rotation, scale or translation moves the farthest vertex by about the same fraction of a pixel.
TEST(OperatingPoint, StepsMoveTheHeadAboutEquallyFar) {
  for (const double eye : {30.0, 60.0, 120.0}) {
    const QuantiserSteps s = OperatingPoint::at(50, eye).steps;
    const double shift_px = s.translation / 64.0;
    const double turn_px = s.rotation * 6.2832 / 65536 * 1.3 * eye;
    const double scale_px = s.log_scale / 4096.0 * 0.6931 * 1.3 * eye;
    EXPECT_NEAR(turn_px / shift_px, 1, 0.25) << eye;
    EXPECT_NEAR(scale_px / shift_px, 1, 0.25) << eye;
    EXPECT_LT(shift_px, 1);
  }
}

}  // namespace
}  // namespace fbs
