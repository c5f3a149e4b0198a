#include "encoder/plan/knot_descent.h"

#include <gtest/gtest.h>

#include <random>

#include "bitstream/track.h"
#include "tests/unit/encoder/plan/flat_group.h"

namespace fbs {
namespace {

/// Distortion of a whole group, all parts together, plus lambda * bits.
double total(const PlanTerms& terms, const MotionGroup& group) {
  double sum = 0;
  std::vector<GroupCost::Row> error(terms.cost.pictures());
  for (std::size_t part = 0; part < kPartCount; ++part) {
    Knot last = anchor_knot(group.anchor, part);
    for (const Knot& knot : group.tracks[part]) {
      sum += terms.lambda * terms.rate.knot(part, last, knot, group.pictures);
      for (int t = last.picture + 1; t <= knot.picture; ++t) {
        const PartPoint x = on_line(last.value, knot.value, part,
                                    static_cast<double>(t - last.picture) / (knot.picture - last.picture));
        for (std::size_t k = 0; k < kPartSizes[part]; ++k)
          error[t][kPartFirst[part] + k] = x[k] - terms.cost.target(t)[kPartFirst[part] + k];
      }
      last = knot;
    }
  }
  for (std::size_t t = 0; t < error.size(); ++t)
    for (std::size_t i = 0; i < kParameterCount; ++i)
      for (std::size_t j = 0; j < kParameterCount; ++j)
        sum +=
            error[t][i] * static_cast<double>(terms.cost.quadratic(t)[i * kParameterCount + j]) * error[t][j];
  return sum;
}

/// Pictures whose parts cost together: what one gets wrong another can make up for.
std::vector<PictureCost> tangled(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  auto pictures = flat_group(count, 10);
  for (PictureCost& p : pictures) {
    for (int k = 0; k < 30; ++k) {
      cv::Mat1d row(1, kParameterCount);
      for (int i = 0; i < kParameterCount; ++i) row(i) = normal(random) / step_of(kFlatSteps, i);
      p.layers.front().quadratic += row.t() * row;
    }
    for (std::size_t i = 0; i < kPoseCount; ++i) p.fit[i] += 2 * normal(random) * step_of(kFlatSteps, i);
  }
  return pictures;
}

TEST(KnotDescent, EachSweepLowersTheTotalUntilNothingChanges) {
  for (unsigned seed = 1; seed < 4; ++seed) {
    const auto pictures = tangled(8, seed);
    const GroupCost cost(pictures, {}, flat_steps());
    const TrackRate rate;
    const CodedLimits limits(kFlatSteps, kAllParts);
    const PlanTerms terms{cost, rate, limits, 5};
    MotionGroup group = knots_everywhere(flat_anchor(), std::vector(8, flat_anchor()), kAllParts);
    KnotDescent descent(terms, group);
    double last = total(terms, group);
    int sweeps = 0;
    while (descent.sweep()) {
      const double now = total(terms, group);
      EXPECT_LT(now, last) << seed;
      last = now;
      ASSERT_LT(++sweeps, 100);
    }
    EXPECT_GT(sweeps, 0);
    EXPECT_NEAR(total(terms, group), last, 1e-6 * last);
  }
}

TEST(KnotDescent, DropsKnotsThatDoNotPay) {
  const auto pictures = flat_group(6, 10);
  const GroupCost cost(pictures, {}, flat_steps());
  const TrackRate rate;
  const CodedLimits limits(kFlatSteps, kAllParts);
  MotionGroup group = knots_everywhere(flat_anchor(), std::vector(6, flat_anchor()), kAllParts);
  KnotDescent descent({cost, rate, limits, 5}, group);
  EXPECT_TRUE(descent.sweep());
  for (const Track& track : group.tracks) {
    ASSERT_EQ(track.size(), 1U);
    EXPECT_EQ(track.front().picture, 5);
  }
}

}  // namespace
}  // namespace fbs
