#include "encoder/surround/surround_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 320, kHeight = 240;
constexpr double kEyePx = 30;
constexpr glm::dvec2 kHeadAt(160, 100);
constexpr int kFirstBody = first_of(PartId::kBody), kFirstGround = first_of(PartId::kGround);

/// As State::body and State::ground, but in pixels.
using Flat = std::array<double, kSimilarityCount>;

/// Waves in all directions: known between the pixels, too.
class Paint {
 public:
  explicit Paint(unsigned seed) {
    std::mt19937 random(seed);
    const auto share = [&] { return random() % 1000 / 1000.0; };
    for (Wave& w : waves_) {
      const double length = 14 + 30 * share(), towards = 6.2832 * share();
      w = {6.2832 / length * glm::dvec2(std::cos(towards), std::sin(towards)), 6.2832 * share()};
    }
  }
  [[nodiscard]] double at(glm::dvec2 p) const {
    double sum = 128;
    for (const Wave& w : waves_) sum += 17 * std::sin(w.number.x * p.x + w.number.y * p.y + w.phase);
    return sum;
  }

 private:
  struct Wave {
    glm::dvec2 number;
    double phase;
  };
  std::array<Wave, 6> waves_;
};

/// The place in the first picture of what is now at `p`.
glm::dvec2 before(glm::dvec2 p, const Flat& flat) {
  const glm::dvec2 way(flat[kDisplacementX], flat[kDisplacementY]);
  const glm::dvec2 d = p - kHeadAt - way;
  const auto q = std::complex(d.x, d.y) /
                 (1.0 + std::complex(flat[kSimilarityScale], flat[kSimilarityRotation]) / kEyePx);
  return kHeadAt + glm::dvec2(q.real(), q.imag());
}

/// Where everything is in a picture.
struct Shown {
  glm::dvec2 head{};  ///< pixels from kHeadAt
  Flat body{}, ground{};
};

State seen_state() {
  State state = toy_state(160, 100);
  state.pose[kLogScale] = static_cast<std::int32_t>(std::lround(4096 * std::log2(kEyePx)));
  return state;
}

Pose head_of(const Shown& shown) {
  Pose pose = pose_of(seen_state());
  pose.shift += shown.head;
  return pose;
}

/// A head, an ellipse of its own paint, before shoulders before the ground.
/// @param noise  grey levels either way
Picture picture_of(const Shown& shown, int noise = 0, bool with_body = true) {
  static const Paint head(1), body(2), ground(3);
  std::mt19937 random(7);
  Picture out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      const glm::dvec2 h = (p - shown.head - kHeadAt) / kEyePx;
      const glm::dvec2 b = before(p, shown.body), own = (b - kHeadAt) / kEyePx;
      double value = 0;
      if (std::hypot(h.x / 1.4, (h.y - 0.3) / 1.9) < 1)
        value = head.at(p - shown.head);
      else if (with_body && own.y > 1.8 + 0.4 * std::abs(own.x))
        value = body.at(b);
      else
        value = ground.at(before(p, shown.ground));
      if (noise > 0) value += static_cast<double>(random() % static_cast<unsigned>(2 * noise + 1)) - noise;
      out.y.row(y)[x] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
  }
  return out;
}

/// Looks at the way to `last` in steps.
SurroundMotion looked_at(const Shown& last, int steps = 4) {
  SurroundMotion motion(picture_of({}), seen_state());
  for (int i = 1; i <= steps; ++i) {
    Shown now = last;
    const double part = i / static_cast<double>(steps);
    now.head *= part;
    for (Flat* flat : {&now.body, &now.ground})
      for (double& n : *flat) n *= part;
    motion.look_at(picture_of(now), head_of(now));
  }
  return motion;
}

State state_of_motion(const SurroundMotion& motion) {
  State state = seen_state();
  motion.add_to(state);
  return state;
}

/// The farthest that a part of the state is from where it should be, over the points of a rectangle; pixels.
double error_over(const std::array<std::int32_t, kSimilarityCount>& found, const Flat& truth, glm::dvec2 low,
                  glm::dvec2 high) {
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

double ground_error(const State& state, const Flat& truth) {
  return error_over(state.ground, truth, {0, 0}, {kWidth, kHeight});
}

double body_error(const State& state, const Flat& truth) {
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

TEST(LayersByPlace, GoFromHeadToBodyBelowAndGroundElsewhere) {
  const Pose pose = pose_of(seen_state());
  for (int y = 0; y < kHeight; y += 5) {
    for (int x = 0; x < kWidth; x += 5) {
      const auto [head, body, ground] = layers_by_place(pose, glm::dvec2(x, y));
      EXPECT_TRUE(head >= 0 && body >= 0 && ground >= 0);
      EXPECT_NEAR(head + body + ground, 1, 1e-5);
    }
  }
  EXPECT_EQ(layers_by_place(pose, kHeadAt)[0], 1);
  EXPECT_GT(layers_by_place(pose, {160, 239})[1], 0.9);
  EXPECT_GT(layers_by_place(pose, {160, 5})[2], 0.9);
  EXPECT_GT(layers_by_place(pose, {10, 100})[2], 0.9);
}

TEST(LayersByPlace, TurnWithTheHead) {
  Pose pose = pose_of(seen_state());
  const auto below = layers_by_place(pose, kHeadAt + glm::dvec2(10, 90));
  const double angle = 0.4;
  pose.roll += angle;
  const auto turned =
      layers_by_place(pose, kHeadAt + glm::dvec2(10 * std::cos(angle) - 90 * std::sin(angle),
                                                 10 * std::sin(angle) + 90 * std::cos(angle)));
  for (std::size_t l = 0; l < 3; ++l) EXPECT_NEAR(turned[l], below[l], 1e-4);
}

TEST(SurroundMotion, StillCameraGivesExactlyZero) {
  SurroundMotion motion(picture_of({}, 3), seen_state());
  for (const glm::dvec2 head : {glm::dvec2(0), {4, 1}, {10, -3}, {-6, 5}, {-14, -8}, {2, 0}}) {
    const Shown now{head, {}, {}};
    motion.look_at(picture_of(now, 3), head_of(now));
    EXPECT_EQ(state_of_motion(motion), seen_state()) << head.x;
  }
}

TEST(SurroundMotion, FindsAGroundThatShiftsGrowsOrTurns) {
  for (const Flat& flat :
       {Flat{6.4, -3.3, 0, 0}, {-2.7, 8.2, 0, 0}, {0, 0, 0.9, 0}, {0, 0, 0, -0.8}, {5.2, 2.1, -0.6, 0.7}}) {
    const Shown last{{-7, 4}, flat, flat};  // the shoulders do not move before the ground
    const State state = state_of_motion(looked_at(last));
    EXPECT_LT(ground_error(state, flat), 0.3) << flat[0] << ' ' << flat[2];
    EXPECT_LT(body_error(state, flat), 0.3) << flat[0] << ' ' << flat[2];
  }
}

TEST(SurroundMotion, BodyMovesApartFromTheGround) {
  for (const Flat& flat : {Flat{5.3, 3.6, 0, 0}, {-6.1, 2.2, 0, 0}, {3.2, 1.4, 0, 0.6}}) {
    const State state = state_of_motion(looked_at({{8, -2}, flat, {}}));
    EXPECT_LT(body_error(state, flat), 0.35) << flat[0];
    EXPECT_EQ(state.ground, seen_state().ground) << flat[0];
  }
  const Flat body{7.2, 1.5, 0, 0}, ground{-3.4, 2.3, 0, 0};
  const State state = state_of_motion(looked_at({{4, 3}, body, ground}));
  EXPECT_LT(body_error(state, body), 0.35);
  EXPECT_LT(ground_error(state, ground), 0.3);
}

// From the first picture to each, not from one to the next.
TEST(SurroundMotion, DoesNotDrift) {
  const Flat away{6.5, -4.5, 0, 0};
  SurroundMotion motion(picture_of({}), seen_state());
  for (int i = 0; i < 24; ++i) {
    Shown now;
    const double part = std::sin(6.2832 * i / 12);
    for (std::size_t k = 0; k < kSimilarityCount; ++k) now.ground[k] = now.body[k] = part * away[k];
    motion.look_at(picture_of(now), head_of(now));
  }
  motion.look_at(picture_of({}), head_of({}));
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
    motion.look_at(picture, head_of({}));
    EXPECT_EQ(state_of_motion(motion), seen_state());
    EXPECT_EQ(cv::countNonZero(cost_of(motion).quadratic()), 0);
  }
}

TEST(SurroundMotion, FormIsSymmetricAndPositiveSemidefinite) {
  SurroundMotion motion = looked_at({{5, 2}, {4.3, 2.6, 0, 0}, {-2.4, 1.1, 0, 0.3}});
  for (const bool mapped : {false, true}) {
    if (mapped) motion.believe(map_of(1, 2));
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

TEST(SurroundMotion, FormHasTheNumbersOfTheState) {
  const SurroundMotion motion = looked_at({{5, 2}, {4.3, 2.6, 0, 0}, {-2.4, 1.1, 0, 0.3}});
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
  motion.look_at(picture_of({}), head_of({}));
  const auto matters = [&](int first) {
    return cv::trace(cost_of(motion).quadratic()(cv::Rect(first, first, 4, 4)))[0];
  };
  motion.believe(map_of(0, 0));
  const double all = matters(kFirstGround);
  EXPECT_GT(all, 0);
  EXPECT_LT(matters(kFirstBody), 1e-9 * all);
  motion.believe(map_of(0, kFollowOne));
  EXPECT_LT(matters(kFirstGround), 1e-9 * all);
  EXPECT_NEAR(matters(kFirstBody), all, 1e-6 * all);
  motion.believe(map_of(kFollowOne, 0));
  EXPECT_LT(matters(kFirstGround), 1e-9 * all);
  EXPECT_LT(matters(kFirstBody), 1e-9 * all);
}

// What the encoder weighs bits against is how pictures differ: it looks at one spot in many samples.
TEST(SurroundMotion, FormPredictsTheChangeOfTheSquaredDifference) {
  const Picture first = picture_of({}, 0, false);
  SurroundMotion motion(first, seen_state());
  motion.believe(map_of(0, 0));
  motion.look_at(first, head_of({}));
  const PictureCost cost = cost_of(motion);
  for (const Flat& by :
       {Flat{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 0.25, 0}, {0, 0, 0, 0.25}, {0.7, 0.7, 0, 0}}) {
    cv::Mat1d e = cv::Mat1d::zeros(kParameterCount, 1);
    for (std::size_t i = 0; i < kSimilarityCount; ++i) e(kFirstGround + static_cast<int>(i)) = 64 * by[i];
    const double predicted = cv::Mat1d(e.t() * cost.quadratic() * e)(0);
    EXPECT_NEAR(squares(picture_of({{}, {}, by}, 0, false), first) / predicted, 1, 0.4)
        << by[0] << ' ' << by[2];
  }
}

}  // namespace
}  // namespace fbs
