#include "decoder/raster/row_runs.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace fbs {
namespace {

constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();

// SPEC 10.6: the half planes of the edges at each centre.
TEST(CoveredRun, IsWhereAllEdgesHold) {
  std::mt19937 random(1);
  int covered = 0;
  for (int i = 0; i < 20000; ++i) {
    // In some rounds corners lie on centres and borders of samples.
    const int unit = i % 2 == 0 ? 1 : 32, reach = i % 7 == 0 ? 1 << 21 : 3000;
    const auto p = [&] {
      const auto within = [&] {
        return (static_cast<int>(random() % static_cast<unsigned>(2 * reach / unit)) - reach / unit) * unit;
      };
      return glm::ivec2(within(), within());
    };
    const ScreenTriangle t = {{{p()}, {p()}, {p()}}};
    const TriangleSetup setup(t, i % 3 == 0 ? PlaneScale::kChroma : PlaneScale::kLuma);
    if (!setup.faces_viewer()) continue;
    const SampleArea area{3, 0, 24, 20};
    const int row = static_cast<int>(random() % 20);
    const RowRun run = covered_run(setup.edges(), row, area);
    for (int x = area.x0; x < area.x1; ++x) {
      bool inside = true;
      for (const Edge& e : setup.edges()) inside = inside && e.a * x + e.b * row + e.c >= 0;
      ASSERT_EQ(x >= run.first && x <= run.last, inside) << i << ": " << x;
      covered += inside ? 1 : 0;
    }
    EXPECT_TRUE(run.empty() || (run.first >= area.x0 && run.last < area.x1));
  }
  EXPECT_GT(covered, 10000);
}

/// Runs drawn, one mark per sample: no sample twice.
template <class Walk>
std::vector<int> marked(std::vector<std::int32_t>& nearest, Walk&& walk) {
  std::vector<int> mark(nearest.size());
  walk([&](RowRun run) {
    EXPECT_FALSE(run.empty());
    for (int x = run.first; x <= run.last; ++x) ++mark[x];
  });
  return mark;
}

TEST(ForEachNearer, DrawsWhatIsNearerAndNotesItsDepth) {
  std::vector<std::int32_t> nearest = {kFar, 5, 20, 30, 30, 90, kFar};
  const auto mark = marked(nearest, [&](auto&& draw) {
    for_each_nearer(nearest.data(), {1, 5}, {10, 10}, draw);
  });
  EXPECT_EQ(mark, (std::vector<int>{0, 0, 0, 0, 0, 1, 0})) << "equal depth is not nearer";
  EXPECT_EQ(nearest, (std::vector<std::int32_t>{kFar, 5, 20, 30, 30, 50, kFar}));
}

TEST(ForEachNearer, RunsAreAsLongAsCanBe) {
  std::vector<std::int32_t> nearest = {9, 9, 0, 9, 9, 9, 0, 0, 9};
  std::vector<int> begins, ends;
  for_each_nearer(nearest.data(), {0, 8}, {4, 0}, [&](RowRun run) {
    begins.push_back(run.first);
    ends.push_back(run.last);
  });
  EXPECT_EQ(begins, (std::vector<int>{0, 3, 8}));
  EXPECT_EQ(ends, (std::vector<int>{1, 5, 8}));
}

TEST(ForEachNearer, DepthIsClampedToItsLimits) {
  for (const std::int64_t z : {std::int64_t{1} << 40, -(std::int64_t{1} << 40)}) {
    std::vector<std::int32_t> nearest(3, kFar);
    const auto mark = marked(nearest, [&](auto&& draw) {
      for_each_nearer(nearest.data(), {0, 2}, {z, 0}, draw);
    });
    EXPECT_EQ(mark, std::vector<int>(3, 1)) << "the farthest depth is still nearer than none";
    EXPECT_EQ(nearest[1], z > 0 ? kMaxDepth : kMinDepth);
  }
}

// The fast walk against the plain one.
TEST(ForEachNearer, UncheckedDepthAgreesWithClamped) {
  std::mt19937 random(2);
  for (int i = 0; i < 5000; ++i) {
    const int count = 1 + static_cast<int>(random() % 40), first = static_cast<int>(random() % 5);
    std::vector<std::int32_t> nearest(50);
    for (std::int32_t& z : nearest) z = random() % 4 == 0 ? kFar : static_cast<int>(random() % 2000) - 1000;
    const DepthRow z{static_cast<int>(random() % 2000) - 1000, static_cast<int>(random() % 200) - 100};
    const RowRun run{first, first + count - 1};
    std::vector<std::int32_t> fast = nearest, plain = nearest, chosen = nearest;
    const auto of_fast = marked(fast, [&](auto&& d) { for_each_nearer_inside(fast.data(), run, z, d); });
    const auto of_plain = marked(plain, [&](auto&& d) { for_each_nearer_clamped(plain.data(), run, z, d); });
    const auto of_chosen = marked(chosen, [&](auto&& d) { for_each_nearer(chosen.data(), run, z, d); });
    ASSERT_TRUE(of_fast == of_plain && fast == plain) << i;
    ASSERT_TRUE(of_chosen == of_plain && chosen == plain) << i;
  }
}

// Depth leaves its limits within the run: the plain walk must be chosen.
TEST(ForEachNearer, ChoosesTheClampedWalkForSteepDepth) {
  for (const std::int64_t step : {std::int64_t{1} << 30, -(std::int64_t{1} << 30)}) {
    std::vector<std::int32_t> plain(8, kFar), chosen(8, kFar);
    for_each_nearer_clamped(plain.data(), {0, 7}, {5, step}, [](RowRun) {});
    for_each_nearer(chosen.data(), {0, 7}, {5, step}, [](RowRun) {});
    EXPECT_EQ(chosen, plain);
    EXPECT_EQ(plain[7], step > 0 ? kMaxDepth : kMinDepth);
  }
}

TEST(DepthPlane, ResetClearsTheAreaAlone) {
  DepthPlane depth;
  depth.reset(6, 4, {0, 0, 6, 4});
  for (int y = 0; y < 4; ++y) std::fill_n(depth.row(y), 6, y);
  depth.reset(6, 4, {1, 1, 3, 3});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x)
      EXPECT_EQ(depth.row(y)[x], x >= 1 && x < 3 && y >= 1 && y < 3 ? kFar : y) << x << ' ' << y;
}

}  // namespace
}  // namespace fbs
