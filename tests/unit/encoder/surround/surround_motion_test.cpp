#include "encoder/surround/surround_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/encoder/surround/painted_surround.h"

namespace fbs {
namespace {

constexpr int kFirstBody = first_of(PartId::kBody), kFirstGround = first_of(PartId::kGround);

/// Observes a motion to `last` in even steps.
SurroundMotion observed(const Shown& last, int steps = 4) {
  SurroundMotion motion(picture_of({}), seen_state());
  for (int i = 1; i <= steps; ++i) {
    Shown now = last;
    const double share = i / static_cast<double>(steps);
    now.head *= share;
    for (Similarity* part : {&now.body, &now.ground})
      for (double& n : *part) n *= share;
    motion.observe(picture_of(now), head_of(now));
  }
  return motion;
}

State state_of_motion(const SurroundMotion& motion) {
  State state = seen_state();
  motion.add_to(state);
  return state;
}

/// The largest error of a part of the state, over the points of a rectangle; pixels.
double error_over(const std::array<std::int32_t, kSimilarityCount>& found, const Similarity& truth,
                  glm::dvec2 low, glm::dvec2 high) {
  double most = 0;
  for (const glm::dvec2 corner : {low, {high.x, low.y}, {low.x, high.y}, high}) {
    const glm::dvec2 d = (corner - kHeadAt) / kEyePx;
    std::array<double, kSimilarityCount> off{};
    for (std::size_t i = 0; i < kSimilarityCount; ++i) off[i] = found[i] / 64.0 - truth[i];
    most = std::max(
        most, std::hypot(off[kDisplacementX] + off[kSimilarityScale] * d.x - off[kSimilarityRotation] * d.y,
                         off[kDisplacementY] + off[kSimilarityScale] * d.y + off[kSimilarityRotation] * d.x));
  }
  return most;
}

double ground_error(const State& state, const Similarity& truth) {
  return error_over(state.ground, truth, {0, 0}, {kWidth, kHeight});
}

double body_error(const State& state, const Similarity& truth) {
  return error_over(state.body, truth, {80, 190}, {240, kHeight});
}

PictureCost cost_of(const SurroundMotion& motion) {
  PictureCost cost;
  motion.add_to(cost);
  return cost;
}

SurroundMap map_of(std::uint8_t head, std::uint8_t body) {
  SurroundMap map{8, 6, {}, {}};
  map.head.assign(9 * 7, head);
  map.body.assign(9 * 7, body);
  return map;
}

TEST(SurroundMotion, StillCameraGivesExactlyZero) {
  SurroundMotion motion(picture_of({}, 3), seen_state());
  for (const glm::dvec2 head : {glm::dvec2(0), {4, 1}, {10, -3}, {-6, 5}, {-14, -8}, {2, 0}}) {
    const Shown now{head, {}, {}};
    motion.observe(picture_of(now, 3), head_of(now));
    EXPECT_EQ(state_of_motion(motion), seen_state()) << head.x;
  }
}

TEST(SurroundMotion, FindsAGroundThatIsShiftedScaledOrRotated) {
  for (const Similarity& by : {Similarity{6.4, -3.3, 0, 0},
                               {-2.7, 8.2, 0, 0},
                               {0, 0, 0.9, 0},
                               {0, 0, 0, -0.8},
                               {5.2, 2.1, -0.6, 0.7}}) {
    const Shown last{{-7, 4}, by, by};  // the shoulders do not move before the ground
    const State state = state_of_motion(observed(last));
    EXPECT_LT(ground_error(state, by), 0.3) << by[0] << ' ' << by[2];
    EXPECT_LT(body_error(state, by), 0.3) << by[0] << ' ' << by[2];
  }
}

TEST(SurroundMotion, BodyMovesApartFromTheGround) {
  for (const Similarity& by : {Similarity{5.3, 3.6, 0, 0}, {-6.1, 2.2, 0, 0}, {3.2, 1.4, 0, 0.6}}) {
    const State state = state_of_motion(observed({{8, -2}, by, {}}));
    EXPECT_LT(body_error(state, by), 0.35) << by[0];
    EXPECT_EQ(state.ground, seen_state().ground) << by[0];
  }
  const Similarity body{7.2, 1.5, 0, 0}, ground{-3.4, 2.3, 0, 0};
  const State state = state_of_motion(observed({{4, 3}, body, ground}));
  EXPECT_LT(body_error(state, body), 0.35);
  EXPECT_LT(ground_error(state, ground), 0.3);
}

// From the first picture to each, not from one to the next.
TEST(SurroundMotion, DoesNotDrift) {
  const Similarity away{6.5, -4.5, 0, 0};
  SurroundMotion motion(picture_of({}), seen_state());
  for (int i = 0; i < 24; ++i) {
    Shown now;
    const double part = std::sin(6.2832 * i / 12);
    for (std::size_t k = 0; k < kSimilarityCount; ++k) now.ground[k] = now.body[k] = part * away[k];
    motion.observe(picture_of(now), head_of(now));
  }
  motion.observe(picture_of({}), head_of({}));
  EXPECT_LT(ground_error(state_of_motion(motion), {}), 0.1);
}

/// An even wall with a camera's noise.
Picture wall(std::uint8_t grey, unsigned seed) {
  std::mt19937 random(seed);
  Picture out(kWidth, kHeight);
  for (auto& s : out.y.samples) s = static_cast<std::uint8_t>(grey + random() % 3);
  return out;
}

TEST(SurroundMotion, NothingToSeeMovesNothing) {
  const Picture flat = wall(90, 1);
  SurroundMotion motion(flat, seen_state());
  for (const Picture& picture : {flat, wall(90, 2), wall(99, 3), picture_of({})}) {
    motion.observe(picture, head_of({}));
    EXPECT_EQ(state_of_motion(motion), seen_state());
    EXPECT_EQ(cv::countNonZero(cost_of(motion).quadratic()), 0);
  }
}

TEST(SurroundMotion, QuadraticIsSymmetricAndPositiveSemidefinite) {
  SurroundMotion motion = observed({{5, 2}, {4.3, 2.6, 0, 0}, {-2.4, 1.1, 0, 0.3}});
  for (const bool mapped : {false, true}) {
    if (mapped) motion.set_map(map_of(1, 2));
    const PictureCost cost = cost_of(motion);
    EXPECT_LT(cv::norm(cost.quadratic() - cost.quadratic().t()), 1e-9 * cv::norm(cost.quadratic()));
    cv::Mat1d values;
    ASSERT_TRUE(cv::eigen(cost.quadratic(), values));
    EXPECT_GT(values(kParameterCount - 1), -1e-9 * values(0));
    for (int i = 0; i < kParameterCount; ++i) {
      const bool flat = i >= kFirstBody && i < kFirstGround + kSimilarityCount;
      EXPECT_EQ(cost.quadratic()(i, i) > 0, flat) << i;
    }
  }
}

TEST(SurroundMotion, CostHasTheNumbersOfTheState) {
  const SurroundMotion motion = observed({{5, 2}, {4.3, 2.6, 0, 0}, {-2.4, 1.1, 0, 0.3}});
  const PictureCost cost = cost_of(motion);
  const State state = state_of_motion(motion);
  for (std::size_t i = 0; i < kSimilarityCount; ++i) {
    EXPECT_EQ(std::lround(cost.fit[kFirstBody + i]), state.body[i]) << i;
    EXPECT_EQ(std::lround(cost.fit[kFirstGround + i]), state.ground[i]) << i;
  }
  EXPECT_NE(state.ground, seen_state().ground) << "the case must occur";
}

TEST(SurroundMotion, MapSaysWhatMattersToWhat) {
  SurroundMotion motion(picture_of({}), seen_state());
  motion.observe(picture_of({}), head_of({}));
  const auto matters = [&](int first) {
    return cv::trace(cost_of(motion).quadratic()(cv::Rect(first, first, 4, 4)))[0];
  };
  motion.set_map(map_of(0, 0));
  const double all = matters(kFirstGround);
  EXPECT_GT(all, 0);
  EXPECT_LT(matters(kFirstBody), 1e-9 * all);
  motion.set_map(map_of(0, kFollowOne));
  EXPECT_LT(matters(kFirstGround), 1e-9 * all);
  EXPECT_NEAR(matters(kFirstBody), all, 1e-6 * all);
  motion.set_map(map_of(kFollowOne, 0));
  EXPECT_LT(matters(kFirstGround), 1e-9 * all);
  EXPECT_LT(matters(kFirstBody), 1e-9 * all);
}

// The encoder weighs the difference of pictures, but samples one spot in many.
TEST(SurroundMotion, QuadraticPredictsTheChangeOfTheSquaredDifference) {
  const Picture first = picture_of({}, 0, false);
  SurroundMotion motion(first, seen_state());
  motion.set_map(map_of(0, 0));
  motion.observe(first, head_of({}));
  const PictureCost cost = cost_of(motion);
  for (const Similarity& by :
       {Similarity{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 0.25, 0}, {0, 0, 0, 0.25}, {0.7, 0.7, 0, 0}}) {
    cv::Mat1d e = cv::Mat1d::zeros(kParameterCount, 1);
    for (std::size_t i = 0; i < kSimilarityCount; ++i) e(kFirstGround + static_cast<int>(i)) = 64 * by[i];
    const double predicted = cv::Mat1d(e.t() * cost.quadratic() * e)(0);
    EXPECT_NEAR(squares(picture_of({{}, {}, by}, 0, false), first) / predicted, 1, 0.4)
        << by[0] << ' ' << by[2];
  }
}

TEST(SurroundMotion, CostsRegionIsTheSurroundDrawnFromPatternZero) {
  const Similarity away = {3.1, -2.2, 0, 0};
  const SurroundMotion motion = observed({{}, away, away});
  const PictureCost cost = cost_of(motion);
  ASSERT_EQ(cost.layers.size(), 1U);
  EXPECT_EQ(cost.layers[0].layer, CostLayer::kSurround);
  EXPECT_EQ(cost.layers[0].pattern, 0);
  // At the similarities found, little remains of the difference at rest.
  const double still = squares(picture_of({{}, away, away}), picture_of({}));
  EXPECT_GT(cost.constant(), 0);
  EXPECT_LT(cost.constant(), 0.1 * still);
}

TEST(SurroundMotion, CostIsZeroWhereNothingHasChanged) {
  SurroundMotion motion(picture_of({}), seen_state());
  motion.observe(picture_of({}), head_of({}));
  EXPECT_EQ(cost_of(motion).constant(), 0);
}

}  // namespace
}  // namespace fbs
