#include "encoder/patterns/pattern_trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/quality.h"
#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

std::vector<Picture> passing_scenery(int count) {
  std::vector<Picture> out;
  for (int k = 0; k < count; ++k) out.push_back(scenery(128, 96, 3 * k));
  return out;
}

SequenceSettings fast(int quantiser) {
  SequenceSettings s;
  s.quantiser = quantiser;
  s.speed = 6;
  return s;
}

TEST(TrialCost, IsWhatTheSequenceTakesAndLoses) {
  const auto pictures = passing_scenery(4);
  const VideoFormat format = format_of(128, 96);
  const auto cost = trial_cost(format, pictures, fast(40));
  const auto coded = code_pattern_sequence(format, pictures, fast(40));
  ASSERT_TRUE(cost);
  ASSERT_TRUE(coded);
  double bytes = 0;
  SquaredError error;
  for (const SequencePattern& p : *coded) {
    bytes += static_cast<double>(p.av1.size());
    error += squared_error(p.decoded.y, pictures[p.picture].y);
  }
  EXPECT_EQ(cost->first_bytes, static_cast<double>(coded->front().av1.size()));
  EXPECT_NEAR(cost->first_bytes + 3 * cost->later_bytes, bytes, 1e-6);
  EXPECT_NEAR(10 * std::log10(255 * 255 / cost->squared_error), error.psnr(), 1e-6);
}

TEST(TrialCost, CoarserCodingTakesFewerBytesAndLosesMore) {
  const auto pictures = passing_scenery(3);
  const auto fine = trial_cost(format_of(128, 96), pictures, fast(20)),
             coarse = trial_cost(format_of(128, 96), pictures, fast(60));
  EXPECT_LT(coarse->first_bytes, fine->first_bytes);
  EXPECT_GT(coarse->squared_error, fine->squared_error);
}

TEST(TrialCost, PassesErrorsOn) {
  EXPECT_FALSE(trial_cost(format_of(128, 128), passing_scenery(2), fast(40)));
}

}  // namespace
}  // namespace fbs
