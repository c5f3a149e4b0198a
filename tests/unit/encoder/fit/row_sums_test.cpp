#include "encoder/fit/row_sums.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace fbs {
namespace {

// Against plain loops, whose order is the same: streams depend on the last bit.
TEST(RowSums, AreThoseOfPlainLoopsToTheLastBit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-1, 1);
  for (const std::size_t stride : {8U, 16U, 40U})
    for (const std::size_t count : {0U, 4U, 28U}) {
      std::vector<float> rows(count * stride), weighted(rows.size()), out(stride * stride);
      for (float& value : rows) value = number(random);
      for (float& value : weighted) value = number(random);
      sum_products(rows.data(), weighted.data(), count, stride, out.data());
      for (std::size_t i = 0; i < stride; ++i)
        for (std::size_t j = i; j < stride; ++j) {
          float sum = 0;
          for (std::size_t row = 0; row < count; row += kRowsTogether) {
            float part = 0;
            for (std::size_t k = row; k < row + kRowsTogether; ++k) {
              const volatile float product = weighted[k * stride + i] * rows[k * stride + j];  // not fused
              part = part + product;
            }
            sum += part;
          }
          EXPECT_EQ(out[i * stride + j], sum) << stride << ' ' << count << ' ' << i << ' ' << j;
        }
    }
}

}  // namespace
}  // namespace fbs
