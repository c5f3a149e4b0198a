#include "decoder/raster/run_walker.h"

#include <gtest/gtest.h>

#include <random>

namespace fbs {
namespace {

/// What triangles can be like.
enum Kind { kAny, kOnCentres, kHuge, kSliver, kWithHorizontalEdge, kKindCount };

ScreenTriangle random_triangle(std::mt19937& random, Kind kind) {
  const auto within = [&](int reach, int unit = 1) {
    return (static_cast<int>(random() % static_cast<unsigned>(2 * reach / unit + 1)) - reach / unit) * unit;
  };
  const int unit = kind == kOnCentres ? 32 : 1, reach = kind == kHuge ? 1 << 21 : 3000;
  const auto p = [&] { return glm::ivec2(within(reach, unit), within(reach, unit)); };
  ScreenTriangle t = {{{p()}, {p()}, {p()}}};
  if (kind == kSliver) {  // a unit or two wide, about the centre of a sample
    const glm::ivec2 centre = glm::ivec2(random() % 40, random() % 40) * 64 + 32,
                     along(within(1 << 20), within(1 << 20)), side(within(2), within(2));
    t = {{{centre - along}, {centre + along + side}, {centre + along - side}}};
  }
  if (kind == kWithHorizontalEdge) t[random() % 3].at.y = t[random() % 3].at.y;
  return t;
}

// Rows above the triangle, through it and below it; areas that cut it at each side.
TEST(RunWalker, GivesTheCoveredRunOfEachRow) {
  std::mt19937 random(1);
  for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
    for (int kind = 0; kind < kKindCount; ++kind) {
      int covered = 0, triangles = 0;
      for (int i = 0; i < 20000; ++i) {
        const TriangleSetup setup(random_triangle(random, static_cast<Kind>(kind)), scale);
        if (!setup.faces_viewer()) continue;
        ++triangles;
        const int x0 = static_cast<int>(random() % 20), y0 = static_cast<int>(random() % 20);
        const SampleArea area{x0, y0, x0 + 1 + static_cast<int>(random() % 40),
                              y0 + 1 + static_cast<int>(random() % 40)};
        RunWalker walker(setup, area.y0, area);
        for (int row = area.y0; row < area.y1; ++row) {
          const RowRun run = walker.next(), expected = covered_run(setup, row, area);
          ASSERT_EQ(run.first, expected.first) << kind << ": " << i << ", row " << row;
          ASSERT_EQ(run.last, expected.last) << kind << ": " << i << ", row " << row;
          covered += run.empty() ? 0 : run.count();
        }
      }
      EXPECT_GT(triangles, 2000) << kind;
      EXPECT_GT(covered, 300) << kind;
    }
  }
}

// Corners on the centres of samples: the top and the left edge belong to the triangle.
TEST(RunWalker, KeepsToTheTopLeftRule) {
  const ScreenTriangle t = {{{{32, 32}}, {{32 + 4 * 64, 32}}, {{32, 32 + 4 * 64}}}};
  RunWalker walker(TriangleSetup(t, PlaneScale::kLuma), 0, {0, 0, 10, 10});
  for (int row = 0; row < 6; ++row) {
    const RowRun run = walker.next();
    EXPECT_EQ(run.count(), row < 4 ? 4 - row : 0) << row;
    EXPECT_EQ(run.first, 0);
  }
}

}  // namespace
}  // namespace fbs
