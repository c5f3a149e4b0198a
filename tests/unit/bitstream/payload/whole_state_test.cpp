#include "bitstream/payload/whole_state.h"

#include <gtest/gtest.h>

#include <random>

#include "bitstream/entropy/range_coder.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr QuantiserSteps kSteps{3, 5, 7, 11, 13};

std::vector<std::uint8_t> coded(CodedState state, const CodedLimits& limits) {
  RangeEncoder encoder;
  EXPECT_TRUE(code_whole_state(encoder, limits, state));
  return encoder.finish();
}

TEST(WholeState, RoundTripsAnyStateWithinItsLimits) {
  std::mt19937 random(5);
  for (const PartMask parts : {kAllParts, PartMask{1}, PartMask{0x111}}) {
    const CodedLimits limits(kSteps, parts);
    for (int i = 0; i < 50; ++i) {
      const CodedState state = random_coded(random, limits);
      const auto bytes = coded(state, limits);
      RangeDecoder decoder(bytes);
      CodedState read;
      read.fill(-1);
      EXPECT_TRUE(code_whole_state(decoder, limits, read));
      EXPECT_EQ(read, state);
      EXPECT_TRUE(decoder.ok() && decoder.at_end());
    }
  }
}

TEST(WholeState, ReportsANumberOutOfRange) {
  CodedState state{};
  state[kYaw] = kMaxRotation / 3;
  const auto bytes = coded(state, CodedLimits(kSteps, kAllParts));
  RangeDecoder decoder(bytes);
  CodedState read{};
  EXPECT_FALSE(code_whole_state(decoder, CodedLimits({4, 5, 7, 11, 13}, kAllParts), read));
}

}  // namespace
}  // namespace fbs
