// Each kernel against its plain counterpart, on every kind of vector that this machine has.
#include "decoder/field/warp_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "decoder/field/warp_kernels_plain.h"
#include "tests/unit/decoder/every_target.h"

namespace fbs {
namespace {

constexpr std::uint8_t kUntouched = 99;

/// Noise, or only black and white, where sums are largest.
std::vector<std::uint8_t> texture(std::mt19937& random, std::size_t size, bool extreme) {
  std::vector<std::uint8_t> out(size);
  for (auto& s : out) s = static_cast<std::uint8_t>(extreme ? (random() % 2) * 255 : random());
  return out;
}

WarpedBlock blank() {
  WarpedBlock out;
  out.samples.fill(kUntouched);
  return out;
}

/// A kernel may write `columns` by `rows` samples, of which `size` by `size` are compared.
void expect_same(const WarpedBlock& out, const WarpedBlock& expected, int size, int columns, int rows) {
  for (int y = 0; y < kBlockSize; ++y) {
    for (int x = 0; x < WarpedBlock::kStride; ++x) {
      const auto k = static_cast<std::size_t>(y * WarpedBlock::kStride + x);
      const bool asked_for = x < size && y < size;
      if (asked_for || x >= columns || y >= rows) {
        ASSERT_EQ(out.samples[k], asked_for ? expected.samples[k] : kUntouched) << x << ',' << y;
      }
    }
  }
}

TEST(WarpKernels, EvenOnesOfLumaEqualThePlainOnes) {
  on_every_target([] {
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
      const glm::ivec2 fraction(random() % 64, random() % 64);
      for (const int size : {8, 16}) {
        constexpr int kStride = 41;
        // Memory ends behind the last sample that may be read.
        const auto from = texture(random, static_cast<std::size_t>(kStride * size + size + 1), i % 2 == 0);
        WarpedBlock out = blank(), expected = blank();
        warp_even_luma(from.data(), kStride, fraction, size, out.samples.data());
        plain::warp_even_luma(from.data(), kStride, fraction, size, expected.samples.data());
        ASSERT_NO_FATAL_FAILURE(expect_same(out, expected, size, size, size)) << i << ": " << size;
      }
    }
  });
}

TEST(WarpKernels, EvenOnesOfChromaEqualThePlainOnes) {
  on_every_target([] {
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
      const glm::ivec2 fraction(random() % 64, random() % 64);
      for (const int size : {4, 8}) {
        constexpr int kStride = 23;
        const auto length = static_cast<std::size_t>(kStride * size + 9);
        const auto u = texture(random, length, i % 2 == 0), v = texture(random, length, i % 3 == 0);
        std::array<WarpedBlock, 2> out{blank(), blank()}, expected{blank(), blank()};
        const auto to = [](std::array<WarpedBlock, 2>& b) {
          return ChromaOut{b[0].samples.data(), b[1].samples.data()};
        };
        warp_even_chroma({u.data(), v.data()}, kStride, fraction, size, to(out));
        plain::warp_even_chroma({u.data(), v.data()}, kStride, fraction, size, to(expected));
        for (int k = 0; k < 2; ++k)
          ASSERT_NO_FATAL_FAILURE(expect_same(out[k], expected[k], size, 8, size)) << i << ": " << size;
      }
    }
  });
}

/// One coordinate of displacements that differ by exactly this much, in any order.
/// @param least  the smallest
std::array<int, 4> spread(std::mt19937& random, int least, int range) {
  std::array<int, 4> out{least, least + range};
  for (std::size_t k = 2; k < 4; ++k)
    out[k] = least + static_cast<int>(random() % static_cast<unsigned>(range + 1));
  std::shuffle(out.begin(), out.end(), random);
  return out;
}

/// A patch in the middle of textures that are large enough for all displacements.
struct BentPatch {
  static constexpr std::ptrdiff_t kStride = 203;
  std::vector<std::uint8_t> u, v;
  PatchNodes nodes;

  BentPatch(std::mt19937& random, glm::ivec2 range)
      : u(texture(random, kStride * 210, random() % 2 == 0)), v(texture(random, kStride * 210, false)) {
    const auto least = [&] { return static_cast<int>(random() % 6000) - 3000; };  // 1/64 sample, both signs
    const auto x = spread(random, least(), range.x), y = spread(random, least(), range.y);
    for (std::size_t k = 0; k < 4; ++k) nodes[k] = {x[k], y[k]};
  }
  [[nodiscard]] ChromaSamples from() const {
    return {u.data() + 95 * kStride + 95, v.data() + 95 * kStride + 95};
  }
};

// Ranges up to the limits of each way to draw a patch, and beyond them.
TEST(WarpKernels, BentOnesEqualThePlainOnes) {
  on_every_target([] {
    std::mt19937 random(4);
    for (const int range_x : {0, 1, 40, 200, 382, 383, 384, 385, 900}) {
      for (const int range_y : {0, 1, 30, 63, 64, 65, 126, 127, 128, 129, 191, 192, 193, 900}) {
        for (int i = 0; i < 12; ++i) {
          const BentPatch patch(random, {range_x, range_y});
          std::array<WarpedBlock, 3> out{blank(), blank(), blank()}, expected = out;
          const auto draw = [&](auto&& luma, auto&& chroma, std::array<WarpedBlock, 3>& to) {
            luma(patch.from()[0], BentPatch::kStride, patch.nodes, to[0].samples.data());
            chroma(patch.from(), BentPatch::kStride, patch.nodes,
                   ChromaOut{to[1].samples.data(), to[2].samples.data()});
          };
          draw(warp_bent_luma, warp_bent_chroma, out);
          draw(plain::warp_bent_luma, plain::warp_bent_chroma, expected);
          for (int k = 0; k < 3; ++k) {
            const int size = k == 0 ? 8 : 4;
            ASSERT_NO_FATAL_FAILURE(expect_same(out[k], expected[k], size, size, size))
                << k << ": " << range_x << ',' << range_y;
          }
        }
      }
    }
  });
}

// Half way down a ramp of 4 levels a row, and a quarter of a sample across one of 4 a column.
TEST(WarpKernels, SamplesLieBetweenThoseOfTheTexture) {
  std::array<std::uint8_t, 40 * 20> ramp{};
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x) ramp[y * 40 + x] = static_cast<std::uint8_t>(4 * x + 4 * y);
  on_every_target([&] {
    WarpedBlock out;
    warp_even_luma(ramp.data(), 40, {16, 32}, 8, out.samples.data());
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) ASSERT_EQ(out.samples[y * WarpedBlock::kStride + x], 4 * x + 4 * y + 3);
  });
}

// The right nodes are displaced by a sample in x, the lower ones by one in y: by an eighth a column or row.
TEST(WarpKernels, BentPatchesFollowTheirNodes) {
  std::array<std::uint8_t, 40 * 20> across{}, down{};
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x) {
      across[y * 40 + x] = static_cast<std::uint8_t>(8 * x);
      down[y * 40 + x] = static_cast<std::uint8_t>(8 * y);
    }
  const PatchNodes nodes{glm::ivec2(0), {64, 0}, {0, 64}, {64, 64}};
  on_every_target([&] {
    std::array<WarpedBlock, 4> out;
    warp_bent_luma(across.data(), 40, nodes, out[0].samples.data());
    warp_bent_luma(down.data(), 40, nodes, out[1].samples.data());
    warp_bent_chroma({across.data(), down.data()}, 40, nodes, {out[2].samples.data(), out[3].samples.data()});
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        ASSERT_EQ(out[0].samples[y * WarpedBlock::kStride + x], 9 * x);
        ASSERT_EQ(out[1].samples[y * WarpedBlock::kStride + x], 9 * y);
      }
    for (int y = 0; y < 4; ++y)  // a chroma sample is two of luma: so is an eighth of them
      for (int x = 0; x < 4; ++x) {
        ASSERT_EQ(out[2].samples[y * WarpedBlock::kStride + x], 9 * x);
        ASSERT_EQ(out[3].samples[y * WarpedBlock::kStride + x], 9 * y);
      }
  });
}

}  // namespace
}  // namespace fbs
