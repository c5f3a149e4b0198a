#include "decoder/export/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fbs {
namespace {

using Keys = std::vector<std::size_t>;

TEST(Keyframes, OfAStraightLineAreItsEnds) {
  const std::vector<double> times{0, 1, 2, 4}, values{0, 2, 4, 8}, exactly{0};
  EXPECT_EQ(find_keyframes(times, values, exactly), (Keys{0, 3}));
}

TEST(Keyframes, StandWhereALineBends) {
  const std::vector<double> times{0, 1, 2, 3, 4}, values{0, 1, 2, 2, 2}, exactly{0};
  EXPECT_EQ(find_keyframes(times, values, exactly), (Keys{0, 2, 4}));
}

TEST(Keyframes, ServeAllNumbersAtOnce) {
  const std::vector<double> times{0, 1, 2, 3}, values{0, 0, 1, 0, 2, 5, 3, 10}, exactly{0, 0};
  EXPECT_EQ(find_keyframes(times, values, exactly), (Keys{0, 1, 3}));
}

TEST(Keyframes, OfOnePictureIsOne) {
  const std::vector<double> one{0}, exactly{0};
  EXPECT_EQ(find_keyframes(one, one, exactly), (Keys{0}));
  EXPECT_EQ(find_keyframes({}, {}, exactly), Keys{});
}

TEST(Keyframes, StayWithinTheTolerance) {
  std::mt19937 random(4);
  std::vector<double> times, values;
  for (int i = 0; i < 500; ++i) {
    times.push_back(0.04 * i);
    values.push_back(std::sin(0.05 * i) + 0.01 * (random() % 100) / 100.0);
  }
  const std::vector<double> tolerance{0.02};
  const Keys keys = find_keyframes(times, values, tolerance);
  EXPECT_LT(keys.size(), 150U);
  for (std::size_t k = 0; k + 1 < keys.size(); ++k)
    for (std::size_t i = keys[k]; i <= keys[k + 1]; ++i) {
      const double f = (times[i] - times[keys[k]]) / (times[keys[k + 1]] - times[keys[k]]);
      EXPECT_NEAR(values[keys[k]] * (1 - f) + values[keys[k + 1]] * f, values[i], 0.02 + 1e-9);
    }
}

}  // namespace
}  // namespace fbs
