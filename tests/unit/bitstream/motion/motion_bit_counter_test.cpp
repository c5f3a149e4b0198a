#include "bitstream/motion/motion_bit_counter.h"

#include <gtest/gtest.h>

#include <numeric>

#include "bitstream/motion/motion_decoder.h"
#include "tests/unit/bitstream/motion/motion_sample.h"

namespace fbs {
namespace {

TEST(MotionBitCounter, PartsSumToThePayload) {
  const auto setup = sample_setup(kSomeParts);
  Sender sender(setup);
  MotionBitCounter counter(setup, sender.seen);
  PartBitsX256 sum{};
  double written = 0;
  for (int g = 0; g < 4; ++g) {
    MotionGroup group = sender.next({.knot_one_in = 3, .moves_one_in = 1, .reach = 4}, 60);
    if (g == 3)
      for (std::uint32_t i = 0; i < 60; ++i) group.durations.push_back(2000 + i * 7 % 50);
    const PartBitsX256 bits = counter.count(group);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += bits[i];
    written += 8 * static_cast<double>(sender.encoder.encode(group)->size());
  }
  const double counted = static_cast<double>(std::accumulate(sum.begin(), sum.end(), std::uint64_t{0})) / 256;
  EXPECT_NEAR(counted, written, 0.01 * written + 4 * 16) << "key flag and end of the code are not counted";
  for (std::size_t p = 0; p < kPartCount; ++p)
    EXPECT_EQ(sum[p] > 0, has_part(kSomeParts, p)) << kPartNames[p];
  EXPECT_GT(sum[kPartCount], 100U * 256) << "durations";
}

// What inspect shows does not depend on what was lost before a key group.
TEST(MotionBitCounter, KeyGroupCostsTheSameAfterALoss) {
  const auto setup = sample_setup();
  Sender sender(setup);
  MotionBitCounter all(setup, sender.seen), after_loss(setup, sender.seen);
  const TrackHabits habits{.knot_one_in = 3, .moves_one_in = 1, .reach = 4};
  for (int g = 0; g < 5; ++g) {
    const MotionGroup group = sender.next(habits, 20, g % 3 == 0);
    ASSERT_TRUE(sender.encoder.encode(group));
    const PartBitsX256 bits = all.count(group);
    const bool lost = g == 1 || g == 2;
    if (!lost) {
      EXPECT_EQ(after_loss.count(group), bits) << g;
    }
  }
}

}  // namespace
}  // namespace fbs
