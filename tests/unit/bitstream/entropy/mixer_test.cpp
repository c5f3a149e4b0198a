#include "bitstream/entropy/mixer.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "bitstream/entropy/bit_counter.h"

namespace fbs {
namespace {

TEST(Mixer, TrustsTheContextThatKnows) {
  std::mt19937 random(3);
  BitCounter counter;
  Mixer<2> mixer;
  std::array<AdaptiveBit, 2> knowing;
  AdaptiveBit blind;
  for (int i = 0; i < 2000; ++i) {
    const bool state = (random() & 1) != 0;
    const bool bit = state != (random() % 32 == 0);
    mixer.code(counter, {&knowing[state ? 1 : 0], &blind}, bit);
  }
  EXPECT_LT(static_cast<double>(counter.bits_x256()) / 256, 2000 * 0.2 * 1.15);  // entropy 0.2006 bit
}

}  // namespace
}  // namespace fbs
