// Each kernel against its plain counterpart, on every kind of vector that this machine has.
#include "decoder/field/blend_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "decoder/field/blend_kernels_plain.h"
#include "tests/unit/decoder/every_target.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// Noise, or only black and white, where sums are largest.
std::vector<std::uint8_t> texture(std::mt19937& random, std::size_t size, bool extreme) {
  std::vector<std::uint8_t> out(size);
  for (auto& s : out) s = static_cast<std::uint8_t>(extreme ? (random() % 2) * 255 : random());
  return out;
}

/// Sources of a block in memory that ends behind their last sample.
struct Sources {
  static constexpr int kStride = 37, kChromaStride = 29;
  static constexpr std::size_t kPlaces = 16;   ///< of a row of weights
  static constexpr std::ptrdiff_t kNodes = 5;  ///< in a line
  static constexpr NodeSteps kSteps{kPlaces, kNodes* static_cast<std::ptrdiff_t>(kPlaces)};

  std::vector<std::vector<std::uint8_t>> samples;
  std::vector<std::uint16_t> weights = std::vector<std::uint16_t>((2 * kNodes + 3) * kPlaces);
  std::vector<BlendedSource> items;

  /// @param count  sources whose weights sum to 256 at each node
  Sources(std::mt19937& random, std::size_t count) {
    for (std::size_t s = 0; s < count; ++s) {
      BlendedSource item{};
      for (std::size_t p = 0; p < 3; ++p) {
        const int size = p == 0 ? kBlockSize : kChromaBlockSize, stride = p == 0 ? kStride : kChromaStride;
        samples.push_back(
            texture(random, static_cast<std::size_t>(stride * (size - 1) + size), random() % 3 == 0));
        item.planes[p] = {samples.back().data(), stride};
      }
      item.weight = weights.data() + s;
      items.push_back(item);
    }
    for (std::size_t node = 0; node < weights.size() / kPlaces; ++node) {
      int left = 256;
      for (std::size_t s = 0; s < count; ++s) {
        const bool all = s + 1 == count || random() % 4 == 0;
        const int weight = all ? left : static_cast<int>(random() % static_cast<unsigned>(left + 1));
        weights[node * kPlaces + s] = static_cast<std::uint16_t>(weight);
        left -= weight;
      }
    }
  }
  // The items point into it.
  Sources(const Sources&) = delete;
  Sources& operator=(const Sources&) = delete;
};

TEST(BlendKernels, EqualThePlainOnes) {
  on_every_target([] {
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
      const Sources sources(random, 2 + random() % 12);
      constexpr std::ptrdiff_t kStride = 21;
      std::vector<std::uint8_t> out(kStride * 17, 99), expected = out;
      blend_luma_block(sources.items, Sources::kSteps, out.data(), kStride);
      plain::blend_luma_block(sources.items, Sources::kSteps, expected.data(), kStride);
      ASSERT_EQ(out, expected) << i;
      std::vector<std::uint8_t> out_v = out;
      std::vector<std::uint8_t> expected_v = out;
      blend_chroma_block(sources.items, Sources::kSteps, {out.data(), out_v.data()}, kStride);
      plain::blend_chroma_block(sources.items, Sources::kSteps, {expected.data(), expected_v.data()},
                                kStride);
      ASSERT_EQ(out, expected) << i;
      ASSERT_EQ(out_v, expected_v) << i;
    }
  });
}

TEST(BlendKernels, BlendOfEqualSourcesIsWhatTheyShow) {
  on_every_target([] {
    std::mt19937 random(2);
    Sources sources(random, 9);
    const auto shown = sources.items[0].planes;
    for (BlendedSource& s : sources.items) s.planes = shown;
    std::vector<std::uint8_t> y(256), u(64), v(64);
    blend_luma_block(sources.items, Sources::kSteps, y.data(), 16);
    blend_chroma_block(sources.items, Sources::kSteps, {u.data(), v.data()}, 8);
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i) ASSERT_EQ(y[j * 16 + i], shown[0].samples[j * shown[0].stride + i]);
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) {
        ASSERT_EQ(u[j * 8 + i], shown[1].samples[j * shown[1].stride + i]);
        ASSERT_EQ(v[j * 8 + i], shown[2].samples[j * shown[2].stride + i]);
      }
  });
}

// From black at the left nodes over white at the middle ones to black again.
TEST(BlendKernels, WeightsAreLinearBetweenNodes) {
  const std::vector<std::uint8_t> black(256, 0), white(256, 255);
  const std::vector<std::uint16_t> weights{256, 0, 0, 256, 256, 0,  //
                                           256, 0, 0, 256, 256, 0,  //
                                           256, 0, 0, 256, 256, 0};
  const auto all = [](const std::vector<std::uint8_t>& p) {
    return std::array<SampleBlock, 3>{{{p.data(), 16}, {p.data(), 16}, {p.data(), 16}}};
  };
  const std::array<BlendedSource, 2> sources{
      {{all(black), weights.data()}, {all(white), weights.data() + 1}}};
  on_every_target([&] {
    std::vector<std::uint8_t> y(256), u(64), v(64);
    blend_luma_block(sources, {2, 6}, y.data(), 16);
    blend_chroma_block(sources, {2, 6}, {u.data(), v.data()}, 8);
    for (int x = 0; x < 16; ++x) EXPECT_NEAR(y[5 * 16 + x], 255 * (8 - std::abs(x - 8)) / 8.0, 0.51) << x;
    for (int x = 0; x < 8; ++x) {
      EXPECT_NEAR(u[3 * 8 + x], 255 * (4 - std::abs(x - 4)) / 4.0, 0.51) << x;
      EXPECT_EQ(v[3 * 8 + x], u[3 * 8 + x]);
    }
  });
}

std::array<PlaneView, 3> planes_of(Picture& p) {
  return {p.y, p.u, p.v};
}

TEST(DrawBlend, OneSourceIsCopied) {
  std::mt19937 random(6);
  const Sources sources(random, 1);
  Picture out(64, 64);
  draw_blend(sources.items, Sources::kSteps, {1, 2}, planes_of(out));
  Picture expected(64, 64);
  const auto& from = sources.items[0].planes;
  for (int j = 0; j < 16; ++j)
    std::copy_n(from[0].samples + j * from[0].stride, 16, expected.y.row(32 + j) + 16);
  for (int j = 0; j < 8; ++j) {
    std::copy_n(from[1].samples + j * from[1].stride, 8, expected.u.row(16 + j) + 8);
    std::copy_n(from[2].samples + j * from[2].stride, 8, expected.v.row(16 + j) + 8);
  }
  EXPECT_EQ(out, expected);
}

/// The upper left part of a plane.
Plane part_of(const Plane& from, const Plane& to) {
  Plane out(to.width, to.height);
  for (int y = 0; y < to.height; ++y) std::copy_n(from.row(y), to.width, out.row(y));
  return out;
}

// Blocks at the right and lower border show what they would in a larger picture.
TEST(DrawBlend, DrawsWhatLiesInThePicture) {
  std::mt19937 random(7);
  for (const std::size_t count : {1U, 2U, 5U}) {
    for (const auto& [width, height] : {std::pair{70, 80}, {80, 67}, {65, 65}, {79, 79}, {72, 72}}) {
      const Sources sources(random, count);
      Picture out(width, height), large(80, 80);
      draw_blend(sources.items, Sources::kSteps, {4, 4}, planes_of(out));
      draw_blend(sources.items, Sources::kSteps, {4, 4}, planes_of(large));
      EXPECT_EQ(out.y, part_of(large.y, out.y)) << width << ' ' << height;
      EXPECT_EQ(out.u, part_of(large.u, out.u)) << width << ' ' << height;
      EXPECT_EQ(out.v, part_of(large.v, out.v)) << width << ' ' << height;
      EXPECT_NE(large.v, Picture(80, 80).v) << "something has been drawn";
    }
  }
}

TEST(DrawBlend, PlanesWithoutSamplesAreLeftOut) {
  std::mt19937 random(8);
  for (const std::size_t count : {1U, 3U}) {
    const Sources sources(random, count);
    Picture all(64, 64), luma(64, 64);
    draw_blend(sources.items, Sources::kSteps, {3, 3}, planes_of(all));
    draw_blend(sources.items, Sources::kSteps, {3, 3}, {luma.y, {}, {}});
    EXPECT_EQ(luma.y, all.y);
    EXPECT_NE(luma.y, Plane(64, 64));
  }
}

TEST(DrawBlend, ChromaPlanesMayHaveTwoStrides) {
  std::mt19937 random(9);
  const Sources sources(random, 4);
  Picture expected(64, 64);
  draw_blend(sources.items, Sources::kSteps, {1, 1}, planes_of(expected));
  Picture out(64, 64);
  std::vector<std::uint8_t> wide(40 * 32, 128);
  draw_blend(sources.items, Sources::kSteps, {1, 1}, {out.y, out.u, {wide.data(), 32, 32, 40}});
  EXPECT_EQ(out.u, expected.u);
  for (int y = 0; y < 32; ++y) {
    EXPECT_TRUE(std::equal(wide.begin() + 40 * y, wide.begin() + 40 * y + 32, expected.v.row(y))) << y;
    EXPECT_EQ(std::count(wide.begin() + 40 * y + 32, wide.begin() + 40 * y + 40, 128), 8) << y;
  }
}

}  // namespace
}  // namespace fbs
