#include "decoder/field/patch_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using Kind = PatchMotion::Kind;
using Whole = BlockMotion::Whole;

TEST(PatchMotion, IsStillOnlyIfAllNodesAre) {
  EXPECT_EQ(PatchMotion::between({}).kind, Kind::kStill);
  const PatchMotion hardly = PatchMotion::between({glm::ivec2(0), {0, 0}, {0, 1}, {0, 0}});
  EXPECT_EQ(hardly.kind, Kind::kEven);
  EXPECT_EQ(hardly.nodes[0], glm::ivec2(0)) << "but not from where the texture's own samples are";
}

TEST(PatchMotion, OfNodesThatHardlyDifferIsTheirMean) {
  const PatchMotion even = PatchMotion::between({glm::ivec2(100, -7), {116, -7}, {101, -9}, {100, -7}});
  EXPECT_EQ(even.kind, Kind::kEven);
  for (const glm::ivec2 d : even.nodes) EXPECT_EQ(d, glm::ivec2(104, -7)) << "(417 + 2) / 4, (-30 + 2) / 4";
  EXPECT_EQ(PatchMotion::between({glm::ivec2(100, 0), {117, 0}, {100, 0}, {100, 0}}).kind, Kind::kBent);
  EXPECT_EQ(PatchMotion::between({glm::ivec2(0, 9), {0, -8}, {0, 0}, {0, 0}}).kind, Kind::kBent);
}

TEST(BlockMotion, IsWholeIfItsPatchesAreAlike) {
  std::vector<glm::ivec2> nodes(5 * 3, {70, -3});
  EXPECT_EQ(BlockMotion::of(nodes.data(), 5).whole, Whole::kEven);
  nodes[2] = {72, -3};  // the upper right patch has another mean
  const BlockMotion motion = BlockMotion::of(nodes.data(), 5);
  EXPECT_EQ(motion.whole, Whole::kNo);
  EXPECT_EQ(motion.patch[1].nodes[0], glm::ivec2(71, -3));
  EXPECT_EQ(motion.patch[2].nodes[0], glm::ivec2(70, -3));
  std::fill(nodes.begin(), nodes.end(), glm::ivec2(0));
  nodes[3] = {900, 900};  // of the next block
  EXPECT_EQ(BlockMotion::of(nodes.data(), 5).whole, Whole::kStill);
  nodes[12] = {900, 0};
  const BlockMotion torn = BlockMotion::of(nodes.data(), 5);
  EXPECT_EQ(torn.whole, Whole::kNo);
  EXPECT_EQ(torn.patch[0].kind, Kind::kStill);
  EXPECT_EQ(torn.patch[3].kind, Kind::kBent);
}

TEST(PatchMotion, EvenPatchesShowTheTextureDisplaced) {
  const PaddedPicture picture = padded(noise_picture(64, 64, 3));
  const PatchMotion motion{Kind::kEven, {glm::ivec2(128, -192), {128, -192}, {128, -192}, {128, -192}}};
  WarpedBlock luma, u, v;
  warp_luma(picture[0], motion, {16, 24}, luma.samples.data());
  warp_chroma(picture[1], picture[2], motion, {8, 12}, {u.samples.data(), v.samples.data()});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      ASSERT_EQ(luma.samples[y * WarpedBlock::kStride + x], *picture[0].at(16 + x + 2, 24 + y - 3));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {  // half way between two rows
      const int above = *picture[2].at(8 + x + 1, 12 + y - 2), below = *picture[2].at(8 + x + 1, 12 + y - 1);
      ASSERT_EQ(v.samples[y * WarpedBlock::kStride + x], (above + below + 1) / 2);
    }
}

// What is even and what is bent meet without a step when the nodes are the same.
TEST(PatchMotion, BentPatchOfEqualNodesIsAnEvenOne) {
  std::mt19937 random(4);
  const PaddedPicture picture = padded(noise_picture(64, 64, 5));
  for (int i = 0; i < 50; ++i) {
    const glm::ivec2 by(static_cast<int>(random() % 1500) - 750, static_cast<int>(random() % 1500) - 750);
    const PatchNodes nodes{by, by, by, by};
    const auto drawn = [&](Kind kind) {
      std::array<WarpedBlock, 3> out{};
      warp_luma(picture[0], {kind, nodes}, {24, 32}, out[0].samples.data());
      warp_chroma(picture[1], picture[2], {kind, nodes}, {12, 16},
                  {out[1].samples.data(), out[2].samples.data()});
      std::vector<std::uint8_t> samples;
      for (int p = 0; p < 3; ++p)
        for (int y = 0; y < (p == 0 ? 8 : 4); ++y) {
          const auto row = out[p].samples.begin() + y * WarpedBlock::kStride;
          samples.insert(samples.end(), row, row + (p == 0 ? 8 : 4));
        }
      return samples;
    };
    ASSERT_EQ(drawn(Kind::kEven), drawn(Kind::kBent)) << by.x << ',' << by.y;
  }
}

TEST(Displaced, WholeSamplesAreNotCopied) {
  const PaddedPlane plane(noise_plane(64, 64, 6), 2);
  WarpedBlock memory;
  const SampleBlock whole = displaced(plane, {16, 16}, {-64 * 20, 64 * 3}, 16, memory.samples.data());
  EXPECT_EQ(whole.samples, plane.at(-4, 19));
  EXPECT_EQ(whole.stride, plane.stride());
  const SampleBlock between = displaced(plane, {16, 16}, {1, 0}, 16, memory.samples.data());
  EXPECT_EQ(between.samples, memory.samples.data());
}

}  // namespace
}  // namespace fbs
