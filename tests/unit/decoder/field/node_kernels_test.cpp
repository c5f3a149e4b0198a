// Each kernel against its plain counterpart, on every kind of vector that this machine has.
#include "decoder/field/node_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "decoder/field/node_kernels_plain.h"
#include "decoder/field/node_weights.h"
#include "tests/unit/decoder/every_target.h"

namespace fbs {
namespace {

/// Sizes of rows: the least, a few, and the most that a picture can have.
constexpr std::size_t kRows[] = {8, 16, 56};

constexpr std::size_t kPoints = 14;

std::int32_t within(std::mt19937& random, std::int32_t low, std::int32_t high) {
  return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low + 1));
}

/// The nodes of a small picture, some of them covered by random triangles.
NodeCover random_cover(std::mt19937& random) {
  std::vector<glm::ivec2> points(kPoints);
  for (glm::ivec2& p : points) p = {within(random, -1000, 6000), within(random, -1000, 6000)};
  std::vector<MeshTriangle> triangles;
  for (int t = 0; t < 10; ++t) {
    const auto point = [&] { return within(random, 0, kPoints - 1); };
    const MeshTriangle c{point(), point(), point()};
    triangles.push_back(c);
    triangles.push_back({c[0], c[2], c[1]});  // one of them faces the viewer
  }
  NodeCover cover;
  cover.find(NodeGrid(64, 80), triangles, points);
  return cover;
}

bool has_both_kinds(const NodeCover& cover) {
  const auto covered = std::count_if(cover.places().begin(), cover.places().end(),
                                     [](const NodePlace& p) { return p.is_covered(); });
  return covered > 0 && covered < static_cast<std::ptrdiff_t>(cover.places().size());
}

/// Weights of the points, of which some are of few sources and others alike: then many are the largest.
/// @param one  their sum
template <class T>
std::vector<T> random_weights(std::mt19937& random, std::size_t points, std::size_t row, std::int32_t one) {
  std::vector<T> out(points * row);
  const std::size_t sources = row - random() % 3;
  const bool alike = random() % 2 == 0;
  for (std::size_t p = 0; p < points; ++p) {
    T* const weight = out.data() + p * row;
    std::int32_t left = one;
    if (alike)
      for (std::size_t s = 0; s < sources; ++s) weight[s] = static_cast<T>(one / static_cast<int>(sources));
    else
      for (std::size_t k = 0; k < 6; ++k)
        weight[random() % sources] = static_cast<T>(random() % static_cast<unsigned>(one / 6));
    for (std::size_t s = 0; s < row; ++s) left -= weight[s];
    T& rest = weight[random() % sources];
    rest = static_cast<T>(rest + left);
  }
  return out;
}

TEST(WeighNodes, EqualsThePlainOne) {
  on_every_target([] {
    std::mt19937 random(1);
    int mixed = 0;
    for (int i = 0; i < 60; ++i) {
      const NodeCover cover = random_cover(random);
      mixed += has_both_kinds(cover) ? 1 : 0;
      for (const std::size_t row : kRows) {
        const auto corners = random_weights<std::int32_t>(random, kPoints, row, kMeshWeightOne);
        const auto outside = random_weights<std::uint16_t>(random, 1, row, kNodeWeightOne);
        std::vector<std::uint16_t> out(cover.places().size() * row + 1, 9999), expected = out;
        const int step_log2 = i % 2 == 0 ? kSurroundStepLog2 : kAtlasStepLog2;
        weigh_nodes(cover.places(), corners.data(), outside.data(), row, step_log2, out.data());
        plain::weigh_nodes(cover.places(), corners.data(), outside.data(), row, step_log2, expected.data());
        ASSERT_EQ(out, expected) << i << ": " << row;
      }
    }
    EXPECT_GT(mixed, 30);
  });
}

// Three sources of a third each: 5, 11 and 16 sixteenths when summed.
TEST(WeighNodes, SumsAreRounded) {
  const NodePlace place{{0, 0, 0}, {0, 0}};
  on_every_target([&] {
    for (const std::array<std::size_t, 3>& sources :
         {std::array<std::size_t, 3>{0, 1, 2}, {2, 5, 6}, {7, 8, 40}, {13, 31, 55}, {3, 11, 19}}) {
      std::vector<std::int32_t> corners(56);
      std::vector<std::uint16_t> out(56), expected(56);
      for (const std::size_t s : sources) {
        corners[s] = kMeshWeightOne / 3;
        expected[s] = 5 << kSurroundStepLog2;
      }
      expected[sources[1]] = 6 << kSurroundStepLog2;
      weigh_nodes({&place, 1}, corners.data(), nullptr, 56, kSurroundStepLog2, out.data());
      EXPECT_EQ(out, expected) << sources[0];
    }
  });
}

TEST(DisplaceNodes, EqualsThePlainOne) {
  on_every_target([] {
    std::mt19937 random(2);
    int mixed = 0, at_limit = 0;
    for (int i = 0; i < 60; ++i) {
      const NodeCover cover = random_cover(random);
      mixed += has_both_kinds(cover) ? 1 : 0;
      const NodeLimits limits{{within(random, -3000, 0), within(random, -3000, 0)},
                              {within(random, 4096, 8000), within(random, 5120, 9000)}};
      for (const std::size_t row : kRows) {
        std::vector<std::int32_t> moved(kPoints * 2 * row);
        // As far apart as they may be, or near the limits of the picture.
        const std::int32_t most = i % 2 == 0 ? kMaxShortDisplacement - 1 : 3000;
        for (std::int32_t& d : moved)
          d = random() % 3 == 0 ? (random() % 2 == 0 ? most : -most) : within(random, -most, most);
        std::vector<std::int32_t> out(cover.places().size() * 2 * row + 1, 1 << 30), expected = out;
        displace_nodes(cover, moved.data(), limits, row, out.data());
        plain::displace_nodes(cover, moved.data(), limits, row, expected.data());
        ASSERT_EQ(out, expected) << i << ": " << row;
        // Node (0, 0) stands at 32, 32.
        at_limit += expected[0] == limits.first.x - 32 || expected[0] == limits.last.x - 32 ? 1 : 0;
      }
    }
    EXPECT_GT(mixed, 30);
    EXPECT_GT(at_limit, 5);
  });
}

/// The nodes of a block, and of those to its right.
class Nodes {
 public:
  static constexpr int kColumns = 5;
  explicit Nodes(std::size_t row = kRowStep)
      : row_(row), weights_(3 * kColumns * row), displacements_(3 * kColumns * 2 * row) {
    for (int node = 0; node < 3 * kColumns; ++node) weight(node, 0) = 256;
  }

  /// @param node  row by row, of kColumns
  [[nodiscard]] std::uint16_t& weight(int node, std::size_t source) {
    return weights_[static_cast<std::size_t>(node) * row_ + source];
  }
  void displace(int node, std::size_t source, glm::ivec2 by) {
    std::int32_t* const d = displacements_.data() + static_cast<std::size_t>(node) * 2 * row_ + source;
    d[0] = by.x;
    d[row_] = by.y;
  }
  void displace_all(std::size_t source, glm::ivec2 by) {
    for (int node = 0; node < 3 * kColumns; ++node) displace(node, source, by);
  }
  [[nodiscard]] BlockNodes of_block(bool moves = true) const {
    return {weights_.data(), moves ? displacements_.data() : nullptr, row_, kColumns};
  }
  [[nodiscard]] BlockMotions motions(std::size_t first = 0) const {
    BlockMotions out{};
    find_motions(of_block(), first, out);
    return out;
  }

 private:
  std::size_t row_;
  std::vector<std::uint16_t> weights_;
  std::vector<std::int32_t> displacements_;
};

/// Nodes which hardly differ, or do, of some sources; many are still.
Nodes random_nodes(std::mt19937& random, std::size_t row) {
  Nodes out(row);
  const bool one_shows = random() % 8 != 0;
  for (std::size_t s = 0; s < row; ++s) {
    for (int node = 0; node < 3 * Nodes::kColumns; ++node)
      out.weight(node, s) = one_shows && random() % 12 == 0 ? static_cast<std::uint16_t>(random() % 257) : 0;
    const glm::ivec2 by(within(random, -2000, 2000), within(random, -2000, 2000));
    const std::int32_t range = std::array{0, 0, 1, 8, 16, 17, 500}[random() % 7];
    const bool still = random() % 4 == 0;
    for (int node = 0; node < 3 * Nodes::kColumns; ++node) {
      const bool stays = still && random() % 12 != 0;
      const glm::ivec2 more(within(random, 0, range), within(random, 0, range));
      out.displace(node, s, stays ? glm::ivec2(0) : by + more);
    }
  }
  return out;
}

/// Compares the sources that are shown; the others are undefined.
void expect_same(const BlockMotions& out, const BlockMotions& expected, std::array<int, 3>& kinds) {
  ASSERT_EQ(out.shown, expected.shown);
  for (std::size_t s = 0; s < kRowStep; ++s) {
    if ((expected.shown >> s & 1) == 0) continue;
    ASSERT_EQ(out.whole[s], expected.whole[s]) << s;
    ++kinds[static_cast<std::size_t>(expected.whole[s])];
    if (expected.whole[s] == kEven) {
      ASSERT_EQ(out.whole_by[0][s], expected.whole_by[0][s]) << s;
      ASSERT_EQ(out.whole_by[1][s], expected.whole_by[1][s]) << s;
    }
    if (expected.whole[s] != kBent) continue;
    for (std::size_t patch = 0; patch < 4; ++patch) {
      ASSERT_EQ(out.kind[patch][s], expected.kind[patch][s]) << s;
      if (expected.kind[patch][s] != kEven) continue;
      ASSERT_EQ(out.by[patch][0][s], expected.by[patch][0][s]) << s;
      ASSERT_EQ(out.by[patch][1][s], expected.by[patch][1][s]) << s;
    }
  }
}

TEST(FindMotions, EqualsThePlainOne) {
  on_every_target([] {
    std::mt19937 random(3);
    std::array<int, 3> kinds{};
    int nothing = 0;
    for (int i = 0; i < 2000; ++i) {
      const std::size_t row = kRows[random() % 3];
      const Nodes nodes = random_nodes(random, row);
      for (std::size_t first = 0; first < row; first += kRowStep) {
        BlockMotions out, expected;
        find_motions(nodes.of_block(i % 16 != 0), first, out);
        plain::find_motions(nodes.of_block(i % 16 != 0), first, expected);
        ASSERT_NO_FATAL_FAILURE(expect_same(out, expected, kinds)) << i << ": " << first;
        nothing += expected.shown == 0 ? 1 : 0;
      }
    }
    EXPECT_GT(nothing, 100);
    for (const int count : kinds) EXPECT_GT(count, 500);
  });
}

TEST(FindMotions, ASourceIsShownIfItHasWeightAtANode) {
  on_every_target([] {
    Nodes nodes(16);
    nodes.weight(0 * Nodes::kColumns + 3, 1) = 256;  // of the next block
    nodes.weight(2 * Nodes::kColumns + 2, 4) = 1;
    nodes.weight(1 * Nodes::kColumns + 1, 15) = 256;
    EXPECT_EQ(nodes.motions().shown, 0b10001U);
    EXPECT_EQ(nodes.motions(8).shown, 0b10000000U);
  });
}

TEST(FindMotions, APatchIsStillOnlyIfAllItsNodesAre) {
  on_every_target([] {
    Nodes nodes;
    EXPECT_EQ(nodes.motions().whole[0], kStill);
    nodes.displace(2 * Nodes::kColumns + 2, 0, {0, 1});
    const BlockMotions hardly = nodes.motions();
    EXPECT_EQ(hardly.whole[0], kEven);
    EXPECT_EQ(hardly.whole_by[1][0], 0) << "but not from where the texture's own samples are";
    nodes.displace(0, 0, {0, 900});  // patch by patch
    EXPECT_EQ(nodes.motions().kind[1][0], kStill);
    EXPECT_EQ(nodes.motions().kind[3][0], kEven);
  });
}

TEST(FindMotions, OfNodesThatHardlyDifferIsTheirMean) {
  const auto of = [](glm::ivec2 a, glm::ivec2 b, glm::ivec2 c, glm::ivec2 d) {
    Nodes nodes;
    nodes.displace(0, 0, a);
    nodes.displace(1, 0, b);
    nodes.displace(Nodes::kColumns, 0, c);
    nodes.displace(Nodes::kColumns + 1, 0, d);
    nodes.displace(2 * Nodes::kColumns, 0, {900, 900});  // the block is not even
    return nodes.motions();
  };
  on_every_target([&] {
    const BlockMotions even = of({100, -7}, {116, -7}, {101, -9}, {100, -7});
    EXPECT_EQ(even.kind[0][0], kEven);
    EXPECT_EQ(even.by[0][0][0], 104) << "(417 + 2) / 4";
    EXPECT_EQ(even.by[0][1][0], -7) << "(-30 + 2) / 4";
    EXPECT_EQ(of({100, 0}, {117, 0}, {100, 0}, {100, 0}).kind[0][0], kBent);
    EXPECT_EQ(of({0, 9}, {0, -8}, {0, 0}, {0, 0}).kind[0][0], kBent);
  });
}

TEST(FindMotions, ABlockIsWholeIfItsNodesHardlyDiffer) {
  on_every_target([] {
    Nodes nodes;
    nodes.displace_all(0, {70, -3});
    EXPECT_EQ(nodes.motions().whole[0], kEven);
    EXPECT_EQ(nodes.motions().whole_by[0][0], 70);
    nodes.displace(2, 0, {86, -3});
    nodes.displace(Nodes::kColumns + 1, 0, {75, -3});  // the middle does not count
    EXPECT_EQ(nodes.motions().whole[0], kEven);
    EXPECT_EQ(nodes.motions().whole_by[0][0], 74) << "(3 * 70 + 86 + 2) / 4";
    EXPECT_EQ(nodes.motions().whole_by[1][0], -3);
    nodes.displace(Nodes::kColumns + 1, 0, {87, -3});
    const BlockMotions unlike = nodes.motions();
    EXPECT_EQ(unlike.whole[0], kBent);
    EXPECT_EQ(unlike.kind[0][0], kBent);
    nodes.displace_all(0, {0, 0});
    nodes.displace(3, 0, {900, 900});  // of the next block
    EXPECT_EQ(nodes.motions().whole[0], kStill);
    nodes.displace(2 * Nodes::kColumns + 2, 0, {900, 0});
    const BlockMotions torn = nodes.motions();
    EXPECT_EQ(torn.whole[0], kBent);
    EXPECT_EQ(torn.kind[0][0], kStill);
    EXPECT_EQ(torn.kind[3][0], kBent);
  });
}

TEST(FindMotions, WithoutDisplacementsAllIsStill) {
  on_every_target([] {
    Nodes nodes;
    nodes.displace_all(0, {64, 64});
    BlockMotions out;
    find_motions(nodes.of_block(false), 0, out);
    EXPECT_EQ(out.shown, 1U);
    EXPECT_EQ(out.whole[0], kStill);
  });
}

}  // namespace
}  // namespace fbs
