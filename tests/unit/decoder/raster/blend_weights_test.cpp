#include "decoder/raster/blend_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "decoder/raster/row_runs.h"

namespace fbs {
namespace {

Lanes all(int value) {
  return Lanes{} + static_cast<std::uint16_t>(value);
}

/// Corners up to `far` pixels outside a picture of 64 x 64.
ScreenTriangle random_triangle(std::mt19937& random, int far) {
  const auto place = [&] {
    return static_cast<int>(random() % static_cast<unsigned>(64 * (64 + 2 * far))) - 64 * far;
  };
  return {{{{place(), place()}}, {{place(), place()}}, {{place(), place()}}}};
}

// SPEC 11.6, word for word, also for slivers whose gradients are clamped.
TEST(LinearWeight, IsTheFormatsFormula) {
  std::mt19937 random(1);
  int blocks = 0;
  for (int i = 0; i < 20000; ++i) {
    ScreenTriangle t = random_triangle(random, i % 2 == 0 ? 4 : 8000);
    if (i % 3 == 0) t[2].at = t[1].at + glm::ivec2(-1, 1);
    const TriangleSetup setup(t, PlaneScale::kLuma);
    if (!setup.faces_viewer()) continue;
    std::array<std::int32_t, 3> weight;
    for (std::int32_t& w : weight) w = static_cast<std::int32_t>(random() % (kWeightOne + 1));
    const int row = std::clamp((setup.first_row() + setup.last_row()) / 2, 0, 63);
    const RowRun run = covered_run(setup, row, {0, 0, 64, 64});
    if (run.empty()) continue;
    ++blocks;
    const RowBlock<PlaneScale::kLuma> block{row, run.first, std::min(run.count(), kLaneCount),
                                            setup.from_corner(run.first, row)};
    const int others = static_cast<int>(random() % (kWeightOne + 1));
    Lanes left = all(others);
    const Lanes taken = LinearWeight<PlaneScale::kLuma>(setup, weight).take(block, left);
    const LinearRow plain = block.along(setup.gradient(weight, 0));
    for (int k = 0; k < block.count; ++k) {
      const std::int64_t expected = std::clamp<std::int64_t>(plain.at(k) >> 16, 0, others);
      ASSERT_EQ(taken[k], expected) << i;
      ASSERT_EQ(left[k], others - expected) << i;
    }
  }
  EXPECT_GT(blocks, 3000);
}

// As many sources as a triangle can have, and the largest samples.
TEST(WeightedSum, IsExactAndRounded) {
  std::mt19937 random(2);
  for (int i = 0; i < 3000; ++i) {
    const int sources = 1 + static_cast<int>(random() % 42);
    WeightedSum sum;
    std::array<int, kLaneCount> plain{}, left;
    left.fill(kWeightOne);
    for (int s = 0; s < sources; ++s) {
      Lanes samples{}, weights{};
      for (int k = 0; k < kLaneCount; ++k) {
        samples[k] = static_cast<std::uint16_t>(i % 3 == 0 ? 255 : random() % 256);
        const int some = i % 2 == 0 ? std::min(left[k], 15 + static_cast<int>(random() % 2) * 16)
                                    : static_cast<int>(random() % static_cast<unsigned>(left[k] + 1));
        weights[k] = static_cast<std::uint16_t>(s + 1 == sources ? left[k] : some);
        left[k] -= weights[k];
        plain[k] += samples[k] * weights[k];
      }
      if (s % WeightedSum::kMaxAdded == WeightedSum::kMaxAdded - 1) sum.carry();
      sum.add(samples, weights);
    }
    const Lanes rounded = sum.rounded();
    for (int k = 0; k < kLaneCount; ++k)
      ASSERT_EQ(rounded[k], (plain[k] + kWeightOne / 2) >> kWeightOneLog2) << i;
  }
}

}  // namespace
}  // namespace fbs
