#include "decoder/blend/head_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "decoder/head/head_mesh.h"

namespace fbs {
namespace {

using Row = std::vector<std::int32_t>;

std::size_t vertices() {
  return generic_head_mesh().vertex_count;
}

/// Sources, still or warped by `still`; every vertex has the same weights.
MeshBlend even_blend(const std::vector<bool>& still, const Row& weights) {
  MeshBlend out;
  for (std::size_t s = 0; s < still.size(); ++s)
    out.sources.push_back({static_cast<std::uint8_t>(s), still[s]});
  out.head.sources = still.size();
  for (std::size_t v = 0; v < vertices(); ++v)
    out.head.weights.insert(out.head.weights.end(), weights.begin(), weights.end());
  return out;
}

void set_row(MeshBlend& blend, std::size_t vertex, const Row& weights) {
  std::ranges::copy(weights,
                    blend.head.weights.begin() + static_cast<std::ptrdiff_t>(vertex * weights.size()));
}

Row row(const PointWeights& weights, std::size_t point) {
  const auto at = weights.at(point);
  return {at.begin(), at.end()};
}

TEST(HeadWeights, WarpedSourcesShareTheAtlasAndStillOnesTheRest) {
  const HeadWeights out = head_weights(even_blend({false, true, false}, {1024, 1024, 2048}), generic_head());
  EXPECT_EQ(out.warped, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(out.still, (std::vector<std::size_t>{1}));
  for (std::size_t v = 0; v < vertices(); ++v) {
    EXPECT_EQ(row(out.atlas, v), (Row{1365, 2731}));
    EXPECT_EQ(row(out.screen, v), (Row{3072, 1024})) << "of the atlas, and of what is still";
  }
}

TEST(HeadWeights, SourcesThatShowNowhereAreLeftOut) {
  const HeadWeights out =
      head_weights(even_blend({false, false, true}, {0, kMeshWeightOne, 0}), generic_head());
  EXPECT_EQ(out.warped, (std::vector<std::size_t>{1}));
  EXPECT_TRUE(out.still.empty());
  EXPECT_EQ(row(out.atlas, 7), Row{kMeshWeightOne});
  EXPECT_EQ(row(out.screen, 7), Row{kMeshWeightOne});
}

TEST(HeadWeights, StillSourcesAloneNeedNoAtlas) {
  const HeadWeights out = head_weights(even_blend({true, true}, {4095, 1}), generic_head());
  EXPECT_TRUE(out.warped.empty());
  EXPECT_TRUE(out.atlas.weights.empty());
  EXPECT_EQ(row(out.screen, 0), (Row{0, 4095, 1}));
}

// The atlas there is not shown, but its neighbours fade to it.
TEST(HeadWeights, WhereNoWarpedSourceShowsTheAtlasHasWhatIsNear) {
  MeshBlend blend = even_blend({false, false, true}, {1000, 3000, 96});
  const std::size_t outline = generic_head().outline[4], ring = kVertexCount + 4;
  set_row(blend, outline, {4096, 0, 0});
  set_row(blend, ring, {0, 0, 4096});
  set_row(blend, 60, {0, 0, 4096});
  const HeadWeights out = head_weights(blend, generic_head());
  EXPECT_EQ(row(out.atlas, ring), (Row{4096, 0})) << "as at the outline";
  EXPECT_EQ(row(out.screen, ring), (Row{0, 4096}));
  // The sums over the head: 1000 and 3000 at 103 vertices, and 4096 of the first at one.
  const std::int64_t first = 103 * 1000 + 4096, all = 103 * 4000 + 4096;
  EXPECT_EQ(row(out.atlas, 60)[0], (first * kMeshWeightOne + all / 2) / all) << "as all of the head";
}

TEST(HeadWeights, OneThatOnlyTheRingShowsIsTheAtlas) {
  MeshBlend blend = even_blend({true, false}, {4096, 0});
  set_row(blend, kVertexCount + 9, {4000, 96});
  const HeadWeights out = head_weights(blend, generic_head());
  EXPECT_EQ(out.warped, std::vector<std::size_t>{1});
  for (std::size_t v = 0; v < vertices(); ++v) EXPECT_EQ(row(out.atlas, v), Row{kMeshWeightOne}) << v;
}

TEST(HeadWeights, RowsSumToOneWhateverTheBlend) {
  std::mt19937 random(4);
  for (int i = 0; i < 60; ++i) {
    const std::size_t count = 1 + random() % 9;
    std::vector<bool> still;
    for (std::size_t s = 0; s < count; ++s) still.push_back(random() % 3 == 0);
    MeshBlend blend = even_blend(still, Row(count));
    for (std::size_t v = 0; v < vertices(); ++v) {
      Row weights(count);
      std::int32_t left = kMeshWeightOne;
      for (std::size_t s = 0; s + 1 < count; ++s)
        left -= weights[s] = random() % 2 == 0 ? 0 : static_cast<std::int32_t>(random() % (left + 1));
      weights.back() = left;
      set_row(blend, v, weights);
    }
    const HeadWeights out = head_weights(blend, generic_head());
    for (std::size_t v = 0; v < vertices(); ++v) {
      const Row screen = row(out.screen, v);
      ASSERT_EQ(std::accumulate(screen.begin(), screen.end(), 0), kMeshWeightOne);
      if (out.warped.empty()) continue;
      const Row atlas = row(out.atlas, v);
      ASSERT_EQ(std::accumulate(atlas.begin(), atlas.end(), 0), kMeshWeightOne);
      for (const std::int32_t w : atlas) ASSERT_GE(w, 0);
    }
  }
}

}  // namespace
}  // namespace fbs
