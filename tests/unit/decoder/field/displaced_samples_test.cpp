#include "decoder/field/displaced_samples.h"

#include <gtest/gtest.h>

#include <glm/vector_relational.hpp>
#include <random>
#include <vector>

#include "decoder/field/warp_kernels_plain.h"
#include "tests/unit/decoder/every_target.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// A patch in all planes.
struct DrawnPatch {
  BlockMemory memory{};
  [[nodiscard]] std::array<std::uint8_t*, 3> out() {
    return {memory[0].samples.data(), memory[1].samples.data(), memory[2].samples.data()};
  }
  [[nodiscard]] int at(std::size_t plane, int x, int y) const {
    return memory[plane].samples[static_cast<std::size_t>(y * WarpedBlock::kStride + x)];
  }
  [[nodiscard]] std::vector<int> samples(bool has_chroma = true) const {
    std::vector<int> all;
    for (std::size_t p = 0; p < (has_chroma ? 3 : 1); ++p)
      for (int y = 0; y < (p == 0 ? 8 : 4); ++y)
        for (int x = 0; x < (p == 0 ? 8 : 4); ++x) all.push_back(at(p, x, y));
    return all;
  }
};

DrawnPatch even_patch(const PaddedPicture& texture, glm::ivec2 patch, glm::ivec2 by, bool has_chroma = true) {
  DrawnPatch out;
  draw_even_patch(texture, patch, by, has_chroma, out.out());
  return out;
}

DrawnPatch bent_patch(const PaddedPicture& texture, glm::ivec2 patch, const PatchNodes& nodes,
                      bool has_chroma = true) {
  DrawnPatch out;
  draw_bent_patch(texture, patch, nodes, has_chroma, out.out());
  return out;
}

TEST(DisplacedSamples, EvenPatchesShowTheTextureDisplaced) {
  const PaddedPicture picture = padded(noise_picture(64, 64, 3));
  const DrawnPatch drawn = even_patch(picture, {2, 3}, {128, -192});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) ASSERT_EQ(drawn.at(0, x, y), *picture[0].at(16 + x + 2, 24 + y - 3));
  for (std::size_t plane = 1; plane < 3; ++plane)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {  // half way between two rows
        const int above = *picture[plane].at(8 + x + 1, 12 + y - 2),
                  below = *picture[plane].at(8 + x + 1, 12 + y - 1);
        ASSERT_EQ(drawn.at(plane, x, y), (above + below + 1) / 2);
      }
}

// What is even and what is bent meet without a step when the nodes are the same.
TEST(DisplacedSamples, BentPatchOfEqualNodesIsAnEvenOne) {
  std::mt19937 random(4);
  const PaddedPicture picture = padded(noise_picture(64, 64, 5));
  on_every_target([&] {
    for (int i = 0; i < 50; ++i) {
      const glm::ivec2 by(static_cast<int>(random() % 1500) - 750, static_cast<int>(random() % 1500) - 750);
      ASSERT_EQ(bent_patch(picture, {3, 4}, {by, by, by, by}).samples(),
                even_patch(picture, {3, 4}, by).samples())
          << by.x << ',' << by.y;
    }
  });
}

TEST(DisplacedSamples, WholeSamplesAreNotCopied) {
  const PaddedPicture picture = padded(noise_picture(64, 64, 6));
  BlockMemory memory;
  const BlockSamples3 whole = displaced_block(picture, {1, 1}, {-64 * 20, 64 * 4}, true, memory);
  EXPECT_EQ(whole[0].samples, picture[0].at(-4, 20));
  EXPECT_EQ(whole[0].stride, picture[0].stride());
  EXPECT_EQ(whole[1].samples, picture[1].at(-2, 10));
  EXPECT_EQ(whole[2].samples, picture[2].at(-2, 10));
  EXPECT_EQ(whole[2].stride, picture[2].stride());
  const BlockSamples3 of_luma = displaced_block(picture, {1, 1}, {64, 64 * 3}, true, memory);
  EXPECT_EQ(of_luma[0].samples, picture[0].at(17, 19));
  EXPECT_EQ(of_luma[1].samples, memory[1].samples.data()) << "between samples of chroma";
  const BlockSamples3 of_chroma = displaced_block(picture, {1, 1}, {1, 0}, true, memory);
  EXPECT_EQ(of_chroma[0].samples, memory[0].samples.data());
  EXPECT_EQ(of_chroma[1].samples, picture[1].at(8, 8)) << "1/128 is none";
}

// A block is its four patches.
TEST(DisplacedSamples, BlocksAreEvenPatches) {
  std::mt19937 random(7);
  const PaddedPicture picture = padded(noise_picture(80, 64, 8));
  for (int i = 0; i < 50; ++i) {
    const glm::ivec2 by(static_cast<int>(random() % 1500) - 750, static_cast<int>(random() % 1500) - 750);
    BlockMemory memory;
    const BlockSamples3 block = displaced_block(picture, {2, 1}, by, true, memory);
    for (int k = 0; k < 4; ++k) {
      const DrawnPatch patch = even_patch(picture, {4 + k % 2, 2 + k / 2}, by);
      for (std::size_t p = 0; p < 3; ++p) {
        const int size = p == 0 ? 8 : 4;
        for (int y = 0; y < size; ++y)
          for (int x = 0; x < size; ++x)
            ASSERT_EQ(block[p].samples[(k / 2 * size + y) * block[p].stride + k % 2 * size + x],
                      patch.at(p, x, y))
                << by.x << ',' << by.y;
      }
    }
  }
}

TEST(DisplacedSamples, WithoutChromaOnlyLumaIsDrawn) {
  const PaddedPicture picture = padded(noise_picture(64, 64, 9));
  const PatchNodes nodes{glm::ivec2(100, 3), {150, -5}, {90, 4}, {80, 70}};
  const DrawnPatch even = even_patch(picture, {1, 1}, {70, 3}, false),
                   bent = bent_patch(picture, {1, 1}, nodes, false);
  EXPECT_EQ(even.samples(false), even_patch(picture, {1, 1}, {70, 3}).samples(false));
  EXPECT_EQ(bent.samples(false), bent_patch(picture, {1, 1}, nodes).samples(false));
  for (std::size_t p = 1; p < 3; ++p)
    for (const std::uint8_t s : {even.memory[p].samples[0], bent.memory[p].samples[0]}) EXPECT_EQ(s, 0);
  BlockMemory memory;
  const BlockSamples3 block = displaced_block(picture, {1, 1}, {70, 3}, false, memory);
  EXPECT_EQ(block[0].samples, memory[0].samples.data());
  EXPECT_EQ(block[1].samples, nullptr);
}

// One node at the limit that SurroundField keeps to, the others as far as they may be (address sanitizer).
TEST(DisplacedSamples, PatchesReadNoFartherThanTheBorder) {
  const glm::ivec2 size(80, 64);
  const PaddedPicture picture = padded(noise_picture(size.x, size.y, 10));
  constexpr int kFar = kMaxOutside * 64;
  on_every_target([&] {
    std::mt19937 random(11);
    for (const glm::ivec2 patch : {glm::ivec2(0, 0), {9, 7}, {4, 4}}) {
      for (const bool lower_right : {false, true}) {
        for (int i = 0; i < 300; ++i) {
          const auto limit = [&](int k, bool last) {
            const glm::ivec2 node(NodeGrid::place(patch.x + k % 2), NodeGrid::place(patch.y + k / 2));
            return (last ? size * 64 + kFar : glm::ivec2(-kFar)) - node;
          };
          const unsigned reach_x = std::array{1U, 64U, 384U}[random() % 3],
                         reach_y = std::array{1U, 64U, 192U, 384U}[random() % 4];
          const int away = lower_right ? -1 : 1;
          PatchNodes nodes;
          for (int k = 0; k < 4; ++k) {
            const glm::ivec2 off(away * static_cast<int>(random() % reach_x),
                                 away * static_cast<int>(random() % reach_y));
            nodes[k] = limit(lower_right ? 3 : 0, lower_right) + off;
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(nodes[k], limit(k, false))));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(nodes[k], limit(k, true))));
          }
          const DrawnPatch drawn = bent_patch(picture, patch, nodes);
          DrawnPatch expected;
          const glm::ivec2 luma = patch * 8, chroma = patch * 4;
          plain::warp_bent_luma(picture[0].at(luma.x, luma.y), picture[0].stride(), nodes, expected.out()[0]);
          plain::warp_bent_chroma({picture[1].at(chroma.x, chroma.y), picture[2].at(chroma.x, chroma.y)},
                                  picture[1].stride(), nodes, {expected.out()[1], expected.out()[2]});
          ASSERT_EQ(drawn.samples(), expected.samples()) << i;
        }
      }
    }
  });
}

}  // namespace
}  // namespace fbs
