#include "bitstream/pattern/pattern_number.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bitstream/entropy/bit_counter.h"
#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

using Numbers = std::vector<std::int32_t>;

TEST(PatternNumber, RoundTripsAnyNumberThatHasAState) {
  std::mt19937 random(1);
  for (const std::int32_t end : {2, 40, 5000, 0x7FFFFFFF}) {
    NumberContexts writing, reading;
    const std::int32_t first = first_with_state(end);
    Numbers store = {0};
    std::int32_t before = 0;
    for (int i = 0; i < 200; ++i) {
      std::int32_t number = std::max(1, first + static_cast<std::int32_t>(random() % (end - first))),
                   read = 0;
      RangeEncoder encoder;
      ASSERT_TRUE(code_number(encoder, writing, store, before, end, number));
      const auto bytes = encoder.finish();
      RangeDecoder decoder(bytes);
      ASSERT_TRUE(code_number(decoder, reading, store, before, end, read));
      ASSERT_EQ(read, number);
      before = number;
      if (store.size() < kMaxPatterns) store.push_back(number);
    }
  }
}

TEST(PatternNumber, MiddlesCostFewBits) {
  NumberContexts contexts;
  Numbers store = {0};
  std::int32_t before = 0;
  double bits = 0;
  const Numbers pyramid = {160, 80, 40, 20, 10, 5, 15, 30, 25, 35, 60, 50, 45, 55, 70, 65, 75};
  for (std::int32_t number : pyramid) {
    BitCounter counter;
    ASSERT_TRUE(code_number(counter, contexts, store, before, 161, number));
    bits += static_cast<double>(counter.bits_x256()) / 256;
    store.push_back(before = number);
  }
  EXPECT_LT(bits / static_cast<double>(pyramid.size()), 3.5);
}

// Among random bytes, only numbers with a state are accepted.
TEST(PatternNumber, RefusesWhatIsOutOfRange) {
  std::mt19937 random(2);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::uint8_t> bytes(8);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    const auto end = static_cast<std::int32_t>(random() % (i % 2 == 0 ? 50 : 0x7FFFFFFF));
    const Numbers store = {0, end / 2, end / 3};
    NumberContexts contexts;
    RangeDecoder decoder(bytes);
    std::int32_t number = 0;
    if (!code_number(decoder, contexts, store, end / 2, end, number)) {
      ++refused;
      continue;
    }
    ASSERT_GE(number, std::max(1, first_with_state(end)));
    ASSERT_LT(number, end);
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace fbs
