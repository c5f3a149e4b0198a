// Each kernel against its plain counterpart, on every kind of vector that this machine has.
#include "decoder/field/patch_kernels.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <functional>
#include <random>
#include <vector>

#include "decoder/field/patch_kernels_plain.h"

namespace fbs {
namespace {

/// @param target  of Highway's; 0: the best that there is
void choose(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Calls check() with each kind of vector chosen in turn.
void on_every_target(const std::function<void()>& check) {
  int checked = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    choose(target);
    SCOPED_TRACE(hwy::TargetName(target));
    check();
    ++checked;
  }
  choose(0);
  EXPECT_GT(checked, 0);
}

/// Noise, or only black and white, where sums are largest.
std::vector<std::uint8_t> texture(std::mt19937& random, std::size_t size, bool extreme) {
  std::vector<std::uint8_t> out(size);
  for (auto& s : out) s = static_cast<std::uint8_t>(extreme ? (random() % 2) * 255 : random());
  return out;
}

struct Sources {
  std::vector<std::vector<std::uint8_t>> samples;
  std::vector<BlendedSource> items;
};

/// @param count  sources whose weights sum to 256 at each node
Sources random_sources(std::mt19937& random, std::size_t count) {
  constexpr std::ptrdiff_t kStride = 37;
  Sources out;
  std::array<int, 9> left{};
  left.fill(256);
  for (std::size_t s = 0; s < count; ++s) {
    out.samples.push_back(texture(random, kStride * 16, random() % 3 == 0));
    BlendedSource item{{out.samples.back().data(), kStride}, {}};
    for (std::size_t k = 0; k < 9; ++k) {
      const bool all = s + 1 == count || random() % 4 == 0;
      const int weight = all ? left[k] : static_cast<int>(random() % static_cast<unsigned>(left[k] + 1));
      item.weight[k] = static_cast<std::uint16_t>(weight);
      left[k] -= weight;
    }
    out.items.push_back(item);
  }
  return out;
}

TEST(PatchKernels, BlendsEqualThePlainOnes) {
  on_every_target([] {
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
      const Sources sources = random_sources(random, 2 + random() % 12);
      constexpr std::ptrdiff_t kStride = 21;
      std::vector<std::uint8_t> out(kStride * 17, 99), expected = out;
      blend_luma_block(sources.items, out.data(), kStride);
      plain::blend_luma_block(sources.items, expected.data(), kStride);
      ASSERT_EQ(out, expected) << i;
      blend_chroma_block(sources.items, out.data(), kStride);
      plain::blend_chroma_block(sources.items, expected.data(), kStride);
      ASSERT_EQ(out, expected) << i;
    }
  });
}

TEST(PatchKernels, BlendOfEqualSourcesIsWhatTheyShow) {
  std::mt19937 random(2);
  Sources sources = random_sources(random, 9);
  for (BlendedSource& s : sources.items) s.block = sources.items[0].block;
  std::vector<std::uint8_t> out(256);
  blend_luma_block(sources.items, out.data(), 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      ASSERT_EQ(out[y * 16 + x], sources.items[0].block.samples[y * sources.items[0].block.stride + x]);
}

/// The part of a block that has been asked for.
std::vector<std::uint8_t> part(const WarpedBlock& block, int columns, int rows) {
  std::vector<std::uint8_t> out;
  for (int y = 0; y < rows; ++y) {
    const auto row = block.samples.begin() + y * WarpedBlock::kStride;
    out.insert(out.end(), row, row + columns);
  }
  return out;
}

TEST(PatchKernels, EvenWarpsEqualThePlainOnes) {
  on_every_target([] {
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
      constexpr std::ptrdiff_t kStride = 41;
      const auto from = texture(random, kStride * 20, i % 2 == 0);
      const glm::ivec2 fraction(random() % 64, random() % 64);
      for (const int size : {4, 8, 16}) {
        WarpedBlock out, expected;
        warp_even(from.data(), kStride, fraction, {size, size}, out.samples.data());
        plain::warp_even(from.data(), kStride, fraction, {size, size}, expected.samples.data());
        ASSERT_EQ(part(out, size, size), part(expected, size, size)) << i << ": " << size;
      }
    }
  });
}

TEST(PatchKernels, BentWarpsEqualThePlainOnes) {
  on_every_target([] {
    std::mt19937 random(4);
    for (int i = 0; i < 300; ++i) {
      constexpr std::ptrdiff_t kStride = 203;
      constexpr int kReach = 90;
      const auto u = texture(random, kStride * 210, i % 2 == 0), v = texture(random, kStride * 210, false);
      const std::uint8_t *const middle_u = u.data() + 95 * kStride + 95, *const middle_v =
                                                                             v.data() + 95 * kStride + 95;
      PatchNodes nodes;
      const unsigned spread = i % 3 == 0 ? 2 * kReach * 64 : 200;
      for (glm::ivec2& d : nodes)
        d = {static_cast<int>(random() % spread) - static_cast<int>(spread) / 2,
             static_cast<int>(random() % spread) - static_cast<int>(spread) / 2};
      std::array<WarpedBlock, 3> out, expected;
      warp_bent_luma(middle_u, kStride, nodes, out[0].samples.data());
      plain::warp_bent_luma(middle_u, kStride, nodes, expected[0].samples.data());
      ASSERT_EQ(part(out[0], 8, 8), part(expected[0], 8, 8)) << i;
      warp_bent_chroma({middle_u, middle_v}, kStride, nodes, {out[1].samples.data(), out[2].samples.data()});
      plain::warp_bent_chroma({middle_u, middle_v}, kStride, nodes,
                              {expected[1].samples.data(), expected[2].samples.data()});
      ASSERT_EQ(part(out[1], 4, 4), part(expected[1], 4, 4)) << i;
      ASSERT_EQ(part(out[2], 4, 4), part(expected[2], 4, 4)) << i;
    }
  });
}

// Half way down a ramp of 8 levels a row, and a quarter of a sample across one of 4 a column.
TEST(PatchKernels, SamplesLieBetweenThoseOfTheTexture) {
  std::array<std::uint8_t, 40 * 20> ramp{};
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x) ramp[y * 40 + x] = static_cast<std::uint8_t>(4 * x + 4 * y);
  WarpedBlock out;
  warp_even(ramp.data(), 40, {16, 32}, {8, 8}, out.samples.data());
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) ASSERT_EQ(out.samples[y * WarpedBlock::kStride + x], 4 * x + 4 * y + 3);
}

}  // namespace
}  // namespace fbs
