#include "encoder/plan/span_search.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "bitstream/track.h"
#include "tests/unit/encoder/plan/flat_group.h"

namespace fbs {
namespace {

struct Search {
  std::vector<PictureCost> pictures;
  GroupCost cost;
  TrackRate rate;
  CodedLimits limits{kFlatSteps, kAllParts};

  explicit Search(const std::vector<PictureCost>& of) : pictures(of), cost(pictures, {}, flat_steps()) {}

  [[nodiscard]] PartValues anchor() const { return anchor_knot(flat_anchor(), 0).value; }
  [[nodiscard]] Track solve(double lambda) const {
    return cheapest_spans({cost, rate, limits, lambda}, 0, anchor());
  }
  /// Cost of the pose alone.
  [[nodiscard]] double total(const Track& track, double lambda) const {
    double sum = 0;
    Knot last{-1, anchor()};
    for (const Knot& knot : track) {
      for (int t = last.picture + 1; t <= knot.picture; ++t)
        sum +=
            cost.distortion(0, t,
                            on_line(last.value, knot.value, 0,
                                    static_cast<double>(t - last.picture) / (knot.picture - last.picture)));
      sum += lambda * rate.knot(0, last, knot, cost.pictures());
      last = knot;
    }
    return sum;
  }
};

Search wandering(int count, unsigned seed) {
  std::mt19937 random(seed);
  auto pictures = flat_group(count, 20);
  double at = 0;
  for (PictureCost& p : pictures) {
    at += static_cast<double>(random() % 5) - 2;
    p.fit[kYaw] = at * kFlatSteps.rotation;
  }
  return Search(pictures);
}

TEST(SpanSearch, HoldsWhereNothingMoves) {
  const Search search(flat_group(12, 20));
  EXPECT_EQ(search.solve(1), (Track{{11, search.anchor()}}));
}

TEST(SpanSearch, JumpsWithinOnePicture) {
  auto pictures = flat_group(12, 20);
  for (std::size_t t = 6; t < 12; ++t) pictures[t].fit[kYaw] = 9 * kFlatSteps.rotation;
  const Track track = Search(pictures).solve(1);
  ASSERT_EQ(track.size(), 3U);
  EXPECT_EQ(track[0].picture, 5);
  EXPECT_EQ(track[1].picture, 6);
  EXPECT_EQ(track[1].value[kYaw], 9);
}

/// All tracks with knots at the rounded fits, held or straight, of a short group.
double cheapest_of_all(const Search& search, double lambda) {
  const int n = search.cost.pictures();
  double least = std::numeric_limits<double>::max();
  for (int mask = 0; mask < 1 << (n - 1); ++mask) {
    Track track;
    for (int t = 0; t < n; ++t)
      if (t == n - 1 || (mask >> t & 1) != 0) track.push_back({t, search.cost.rounded(0, t, search.limits)});
    least = std::min(least, search.total(track, lambda));
  }
  return least;
}

TEST(SpanSearch, IsNotWorseThanAnyChainOfStraightSpans) {
  for (unsigned seed = 1; seed < 8; ++seed) {
    const Search search = wandering(9, seed);
    for (const double lambda : {0.1, 2.0, 30.0})
      EXPECT_LE(search.total(search.solve(lambda), lambda), cheapest_of_all(search, lambda) * (1 + 1e-5))
          << seed << ' ' << lambda;
  }
}

}  // namespace
}  // namespace fbs
