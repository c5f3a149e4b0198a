#include "encoder/plan/track_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/track.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr auto kPose = static_cast<std::size_t>(PartId::kPose);
constexpr auto kLight = static_cast<std::size_t>(PartId::kLight);
constexpr auto kMouth = static_cast<std::size_t>(PartId::kMouth);
constexpr QuantiserSteps kSteps{};

/// Steps of `at` in the units of a fit.
double in_units(std::size_t parameter, double steps) {
  return steps * step_of(kSteps, parameter);
}

/// A picture with the same cost for every number: a step beside the fit costs `weight`.
PictureCost even_fit(double weight) {
  PictureCost fit;
  fit.layers = {{.quadratic = cv::Mat1d::zeros(kParameterCount, kParameterCount)}};
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const double step = step_of(kSteps, i);
    fit.layers.front().quadratic(static_cast<int>(i), static_cast<int>(i)) = weight / (step * step);
  }
  return fit;
}

CodedState anchor_of() {
  CodedState anchor{};
  anchor[kLogScale] = 2560;
  return anchor;
}

/// Pictures that all match the anchor.
std::vector<PictureCost> still_fits(int count, double weight = 50) {
  std::vector<PictureCost> fits(static_cast<std::size_t>(count));
  for (PictureCost& fit : fits) {
    fit = even_fit(weight);
    fit.fit[kLogScale] = in_units(kLogScale, 2560);
  }
  return fits;
}

MotionGroup planned(const std::vector<PictureCost>& fits, double lambda = 1, PartMask parts = kAllParts) {
  return TrackPlanner(kSteps, parts).plan(anchor_of(), fits, TrackRate(), lambda);
}

/// The viewer's loss in a group: the sum over pictures of the forms.
double distortion(const MotionGroup& group, const std::vector<PictureCost>& fits) {
  double sum = 0;
  for (std::size_t t = 0; t < fits.size(); ++t) {
    cv::Mat1d e(kParameterCount, 1);
    for (std::size_t part = 0; part < kPartCount; ++part) {
      Knot a{.picture = -1, .value = {}}, b = a;
      std::copy_n(group.anchor.begin() + kPartFirst[part], kPartSizes[part], b.value.begin());
      for (auto knot = group.tracks[part].begin(); b.picture < static_cast<int>(t); ++knot) a = b, b = *knot;
      const double share =
          b.picture == a.picture ? 1 : (static_cast<int>(t) - a.picture) / (1.0 * b.picture - a.picture);
      for (std::size_t k = 0; k < kPartSizes[part]; ++k) {
        const auto i = kPartFirst[part] + k, p = k;
        e(static_cast<int>(i)) = in_units(i, a.value[p] + share * (b.value[p] - a.value[p])) - fits[t].fit[i];
      }
    }
    sum += cv::Mat1d(e.t() * fits[t].quadratic() * e)(0);
  }
  return sum;
}

double bits(const MotionGroup& group) {
  const TrackRate rate;
  double sum = 0;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    Knot last{.picture = -1, .value = {}};
    std::copy_n(group.anchor.begin() + kPartFirst[part], kPartSizes[part], last.value.begin());
    for (const Knot& knot : group.tracks[part]) {
      sum += rate.knot(part, last, knot, group.pictures);
      last = knot;
    }
  }
  return sum;
}

std::vector<std::int32_t> pictures_of(const Track& track) {
  std::vector<std::int32_t> out;
  for (const Knot& knot : track) out.push_back(knot.picture);
  return out;
}

std::size_t knots_of(const MotionGroup& group) {
  std::size_t count = 0;
  for (const Track& track : group.tracks) count += track.size();
  return count;
}

/// Fits that wander, every number, with forms that couple them.
std::vector<PictureCost> wandering_fits(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<PictureCost> fits = still_fits(count, 20);
  std::array<double, kParameterCount> at{};
  at[kLogScale] = 2560;
  for (PictureCost& fit : fits) {
    for (int k = 0; k < 40; ++k) {
      cv::Mat1d row(1, kParameterCount);
      for (std::size_t i = 0; i < kParameterCount; ++i)
        row(static_cast<int>(i)) = normal(random) / step_of(kSteps, i);
      fit.layers.front().quadratic += row.t() * row;
    }
    for (std::size_t i = 0; i < kParameterCount; ++i) {
      at[i] += (i < kPoseCount ? 1.5 : 0.5) * normal(random);
      fit.fit[i] = in_units(i, at[i]);
    }
  }
  return fits;
}

/// A group with the fits in whole steps at every picture.
MotionGroup rounded_everywhere(const std::vector<PictureCost>& fits) {
  std::vector<CodedState> states(fits.size());
  for (std::size_t t = 0; t < fits.size(); ++t)
    for (std::size_t i = 0; i < kParameterCount; ++i)
      states[t][i] = static_cast<std::int32_t>(std::lround(fits[t].fit[i] / step_of(kSteps, i)));
  return knots_everywhere(anchor_of(), states, kAllParts);
}

TEST(TrackPlanner, WhatHoldsHasOnlyTheKnotAtTheEnd) {
  const MotionGroup group = planned(still_fits(30));
  EXPECT_EQ(group.pictures, 30);
  EXPECT_EQ(group.anchor, anchor_of());
  for (const Track& track : group.tracks) EXPECT_EQ(pictures_of(track), (std::vector{29}));
  EXPECT_EQ(last_of(group), anchor_of());
}

TEST(TrackPlanner, StraightMotionNeedsOneKnot) {
  auto fits = still_fits(20);
  for (std::size_t t = 0; t < 20; ++t) {
    fits[t].fit[kYaw] = in_units(kYaw, 1.5 * (static_cast<double>(t) + 1));
    fits[t].fit[kFirstCoefficient] = in_units(kFirstCoefficient, -0.5 * (static_cast<double>(t) + 1));
  }
  const MotionGroup group = planned(fits);
  EXPECT_EQ(pictures_of(group.tracks[kPose]), (std::vector{19}));
  EXPECT_EQ(group.tracks[kPose].back().value[kYaw], 30);
  EXPECT_EQ(pictures_of(group.tracks[kMouth]), (std::vector{19}));
  EXPECT_EQ(group.tracks[kMouth].back().value[0], -10);
}

TEST(TrackPlanner, BendIsAKnot) {
  auto fits = still_fits(20);
  for (std::size_t t = 0; t < 20; ++t)
    fits[t].fit[kYaw] = in_units(kYaw, t < 9 ? 2.0 * (static_cast<double>(t) + 1) : 18);
  const MotionGroup group = planned(fits);
  EXPECT_EQ(pictures_of(group.tracks[kPose]), (std::vector{8, 19}));
  EXPECT_EQ(group.tracks[kPose][0].value[kYaw], 18);
  EXPECT_EQ(group.tracks[kPose][1].value[kYaw], 18);
}

// A blink or a cut of the mouth must not be smeared over the pictures before.
TEST(TrackPlanner, JumpIsKept) {
  auto fits = still_fits(20);
  for (std::size_t t = 10; t < 20; ++t) fits[t].fit[kFirstCoefficient] = in_units(kFirstCoefficient, 20);
  const MotionGroup group = planned(fits);
  EXPECT_EQ(pictures_of(group.tracks[kMouth]), (std::vector{9, 10, 19}));
  EXPECT_EQ(group.tracks[kMouth][0].value[0], 0);
  EXPECT_EQ(group.tracks[kMouth][1].value[0], 20);
  EXPECT_EQ(group.tracks[kMouth][2].value[0], 20);
  EXPECT_LT(distortion(group, fits), 1e-6);
}

TEST(TrackPlanner, WhatDoesNotPayIsNotCoded) {
  std::mt19937 random(3);
  auto fits = still_fits(30, 0.01);
  for (PictureCost& fit : fits) fit.fit[kYaw] = in_units(kYaw, static_cast<double>(random() % 5) - 2);
  EXPECT_EQ(pictures_of(planned(fits, 100).tracks[kPose]), (std::vector{29}));
  EXPECT_GT(planned(fits, 1e-6).tracks[kPose].size(), 15U) << "it pays when bits cost nothing";
}

TEST(TrackPlanner, LargerLambdaGivesFewerBitsAndMoreDistortion) {
  const auto fits = wandering_fits(20, 5);
  double last_bits = 1e9, last_distortion = -1;
  for (const double lambda : {0.01, 1.0, 10.0, 100.0, 1000.0}) {
    const MotionGroup group = planned(fits, lambda);
    EXPECT_LT(bits(group), last_bits) << lambda;
    EXPECT_GT(distortion(group, fits), last_distortion) << lambda;
    last_bits = bits(group);
    last_distortion = distortion(group, fits);
  }
}

// Neither a knot at every picture nor holding still may beat the choice.
TEST(TrackPlanner, IsNotWorseThanPlainChoices) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto fits = wandering_fits(12, seed);
    const MotionGroup everywhere = rounded_everywhere(fits), still = planned(still_fits(12));
    for (const double lambda : {1.0, 30.0}) {
      const auto cost = [&](const MotionGroup& g) { return distortion(g, fits) + lambda * bits(g); };
      const double chosen = cost(planned(fits, lambda));
      EXPECT_LT(chosen, cost(everywhere)) << seed << ' ' << lambda;
      EXPECT_LT(chosen, cost(still)) << seed << ' ' << lambda;
    }
  }
}

TEST(TrackPlanner, GroupCanBeCoded) {
  auto setup = toy_setup();
  for (const PartMask parts : {kAllParts, PartMask{1}, PartMask{0x093}}) {
    setup.steps = kSteps;
    setup.parts = parts;
    MotionEncoder coder(setup, anchor_of());
    MotionGroup group = planned(wandering_fits(17, 8), 3, parts);
    group.key = true;
    EXPECT_TRUE(coder.encode(group)) << parts;
    for (std::size_t p = 0; p < kPartCount; ++p) EXPECT_EQ(group.tracks[p].empty(), !has_part(parts, p));
  }
}

TEST(TrackPlanner, NumbersStayWithinTheirLimits) {
  auto fits = still_fits(10);
  for (std::size_t t = 0; t < 10; ++t)
    for (std::size_t i = 0; i < kParameterCount; ++i) fits[t].fit[i] = t < 5 ? 1e9 : -1e9;
  const CodedLimits limits(kSteps, kAllParts);
  const MotionGroup group = planned(fits);
  for (std::size_t part = 0; part < kPartCount; ++part) {
    for (const Knot& knot : group.tracks[part]) {
      for (std::size_t k = 0; k < kPartSizes[part]; ++k) {
        const auto i = kPartFirst[part] + k;
        const std::int32_t value = knot.value[k];
        EXPECT_TRUE(value >= limits.min[i] && value <= limits.max[i]) << i << ' ' << value;
      }
    }
  }
  EXPECT_EQ(last_of(group)[kYaw], limits.min[kYaw]);
}

// Two numbers of which the picture sees the sum: half a step of each is one step of either.
TEST(TrackPlanner, NumbersMakeUpForEachOther) {
  for (const auto& [first, second] :
       {std::pair<std::size_t, std::size_t>{kYaw, kShiftX}, {kYaw, kPoseCount + kLightOffset}}) {
    for (const double sign : {1.0, -1.0}) {
      auto fits = still_fits(1, 0);
      PictureCost& fit = fits[0];
      fit.fit[first] = in_units(first, 0.5);
      fit.fit[second] = in_units(second, 0.5 * sign);
      cv::Mat1d sum = cv::Mat1d::zeros(1, kParameterCount);
      sum(static_cast<int>(first)) = 10.0 / step_of(kSteps, first);
      sum(static_cast<int>(second)) = sign * 10.0 / step_of(kSteps, second);
      fit.layers.front().quadratic = sum.t() * sum;
      const MotionGroup group = planned(fits, 0.01);
      EXPECT_LT(distortion(group, fits), 1e-6) << first << ' ' << second << ' ' << sign;
      const CodedState last = last_of(group);
      EXPECT_EQ(std::abs(last[first]) + std::abs(last[second]), 1);
    }
  }
  static_assert(kPose != kLight);
}

// Pictures that do not show the face say nothing: the state goes straight past them.
TEST(TrackPlanner, GoesStraightPastPicturesThatSayNothing) {
  auto fits = still_fits(20);
  for (std::size_t t = 0; t < 20; ++t) {
    fits[t].fit[kYaw] = in_units(kYaw, static_cast<double>(t) + 1);
    if (t > 4 && t < 15) {
      fits[t].layers.front().quadratic = 0;
      fits[t].fit[kYaw] = in_units(kYaw, -40);
    }
  }
  const MotionGroup group = planned(fits);
  EXPECT_EQ(pictures_of(group.tracks[kPose]), (std::vector{19}));
  EXPECT_EQ(knots_of(group), static_cast<std::size_t>(kPartCount));
}

// The last picture says nothing and its fit is wild. Chains go through fits only, so that the first finds a
// bend there; its knot does not pay.
TEST(TrackPlanner, KnotThatDoesNotPayIsDropped) {
  auto fits = still_fits(20, 0.5);
  for (std::size_t t = 0; t < 19; ++t) fits[t].fit[kYaw] = in_units(kYaw, static_cast<double>(t) + 1);
  fits[19].fit[kYaw] = in_units(kYaw, -40);
  fits[19].layers.front().quadratic = 0;
  const MotionGroup group = planned(fits);
  EXPECT_EQ(pictures_of(group.tracks[kPose]), (std::vector{19}));
  EXPECT_NEAR(group.tracks[kPose].back().value[kYaw], 20, 1);
}

// Noise before a jump is no reason to move towards it.
TEST(TrackPlanner, JumpIsKeptBehindNoise) {
  auto fits = still_fits(20, 2);
  for (std::size_t t = 0; t < 20; ++t)
    fits[t].fit[kFirstCoefficient] = in_units(kFirstCoefficient, t < 10 ? (t % 2 == 0 ? -0.8 : 0.8) : 30);
  const MotionGroup group = planned(fits);
  EXPECT_EQ(pictures_of(group.tracks[kMouth]), (std::vector{9, 10, 19}));
  EXPECT_EQ(group.tracks[kMouth][0].value[0], 0);
}

}  // namespace
}  // namespace fbs
