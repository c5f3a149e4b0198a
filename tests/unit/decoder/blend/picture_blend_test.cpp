#include "decoder/blend/picture_blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "decoder/blend/state_distance.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr std::array<Region, kRegionCount> kRegions = {Region::kMouth, Region::kRightEye, Region::kLeftEye,
                                                       Region::kFace,  Region::kHair,     Region::kBody,
                                                       Region::kGround};

/// A head that yaws from picture to picture.
State state_at(std::int32_t picture, int yaw_per_picture = 40) {
  State state = toy_state();
  state.picture = picture;
  state.pose[kYaw] = picture * yaw_per_picture;
  state.body[kDisplacementX] = picture * 5;
  return state;
}

/// Patterns of some pictures.
struct Patterns {
  std::vector<State> states;
  explicit Patterns(const std::vector<std::int32_t>& pictures, int yaw_per_picture = 40) {
    for (const std::int32_t p : pictures) states.push_back(state_at(p, yaw_per_picture));
  }
  [[nodiscard]] RegionBlend blend(const State& picture, Region region, BlendMode mode = {}) const {
    std::vector<const State*> seen;
    for (const State& s : states) seen.push_back(&s);
    return BlendWeights(seen, picture).blend(region, mode);
  }
};

std::int32_t weight_of(const RegionBlend& blend, std::size_t pattern, bool still = false) {
  for (const WeightedSource& s : blend)
    if (s.source == BlendSource{static_cast<std::uint8_t>(pattern), still}) return s.weight;
  return 0;
}

std::int32_t sum_of(const RegionBlend& blend) {
  std::int32_t sum = 0;
  for (const WeightedSource& s : blend) sum += s.weight;
  return sum;
}

BlendMode nearest(int rank) {
  return static_cast<BlendMode>(static_cast<int>(BlendMode::kNearest) + rank);
}

TEST(PictureBlend, KeepsItsPromises) {
  std::mt19937 random(1);
  for (int i = 0; i < 600; ++i) {
    Patterns patterns({});
    for (unsigned n = 1 + random() % 64; n > 0; --n) {
      patterns.states.push_back(random_state(random));
      patterns.states.back().picture = static_cast<std::int32_t>(random() % (i % 2 == 0 ? 40 : 1u << 31));
    }
    State picture = random_state(random);
    picture.picture = static_cast<std::int32_t>(random() % (i % 4 < 2 ? 40 : 1u << 31));
    for (const Region region : kRegions) {
      for (int mode = 0; mode < kBlendModeCount; ++mode) {
        const RegionBlend blend = patterns.blend(picture, region, static_cast<BlendMode>(mode));
        ASSERT_EQ(sum_of(blend), kBlendOne);
        ASSERT_LE(blend.size(), kMaxRegionSources);
        for (std::size_t k = 0; k < blend.size(); ++k) {
          ASSERT_GT(blend[k].weight, 0);
          ASSERT_LT(blend[k].source.pattern, patterns.states.size());
          const auto place = [](const BlendSource& s) { return 2 * s.pattern + (s.still ? 1 : 0); };
          if (k > 0) {
            ASSERT_LT(place(blend[k - 1].source), place(blend[k].source)) << "rising and distinct";
          }
        }
      }
    }
  }
}

TEST(PictureBlend, OnePatternHasAllWeight) {
  const Patterns one({7});
  for (const Region region : kRegions)
    for (int mode = 0; mode < kBlendModeCount; ++mode) {
      const auto m = static_cast<BlendMode>(mode);
      const RegionBlend blend = one.blend(state_at(30), region, m);
      const std::int32_t warped = m == BlendMode::kStillBefore || m == BlendMode::kStillAfter ? 0
                                  : m == BlendMode::kHalfStill                                ? kBlendOne / 2
                                                                                              : kBlendOne;
      EXPECT_EQ(weight_of(blend, 0), warped) << mode;
      EXPECT_EQ(weight_of(blend, 0, true), kBlendOne - warped) << mode;
    }
}

TEST(PictureBlend, CrossFadeFollowsTime) {
  const Patterns patterns({0, 40, 80});
  for (const Region region : kRegions) {
    const auto weight = [&](int picture, std::size_t pattern) {
      return weight_of(patterns.blend(state_at(picture), region, BlendMode::kByTime), pattern);
    };
    EXPECT_EQ(weight(0, 0), kBlendOne);
    EXPECT_EQ(weight(10, 0), 3 * kBlendOne / 4);
    EXPECT_EQ(weight(10, 1), kBlendOne / 4);
    EXPECT_EQ(weight(40, 1), kBlendOne);
    EXPECT_EQ(weight(60, 1), kBlendOne / 2);
    EXPECT_EQ(weight(60, 2), kBlendOne / 2);
    EXPECT_EQ(weight(200, 2), kBlendOne) << "after the last";
  }
}

TEST(PictureBlend, CrossFadeBeforeTheFirstIsTheFirst) {
  const Patterns patterns({20, 40});
  EXPECT_EQ(weight_of(patterns.blend(state_at(3), Region::kFace, BlendMode::kByTime), 0), kBlendOne);
}

// The order in the store is not the order in time.
TEST(PictureBlend, CrossFadeFindsItsNeighboursInAnyOrder) {
  const Patterns patterns({80, 0, 120, 40});
  const RegionBlend blend = patterns.blend(state_at(50), Region::kBody, BlendMode::kByTime);
  EXPECT_EQ(weight_of(blend, 3), 3 * kBlendOne / 4);
  EXPECT_EQ(weight_of(blend, 0), kBlendOne / 4);
}

TEST(PictureBlend, StillModesShowOnePatternAsItIs) {
  const Patterns patterns({0, 40, 80});
  for (const Region region : kRegions) {
    EXPECT_EQ(weight_of(patterns.blend(state_at(50), region, BlendMode::kStillBefore), 1, true), kBlendOne);
    EXPECT_EQ(weight_of(patterns.blend(state_at(50), region, BlendMode::kStillAfter), 2, true), kBlendOne);
    EXPECT_EQ(weight_of(patterns.blend(state_at(90), region, BlendMode::kStillAfter), 2, true), kBlendOne)
        << "behind the last";
  }
}

TEST(PictureBlend, HalfStillIsHalfTheCrossFadeWithoutMotion) {
  const Patterns patterns({0, 40, 80});
  for (const Region region : kRegions) {
    const RegionBlend by_state = patterns.blend(state_at(50), region),
                      half = patterns.blend(state_at(50), region, BlendMode::kHalfStill);
    EXPECT_NEAR(weight_of(half, 1, true), 3 * kBlendOne / 8, 1);
    EXPECT_NEAR(weight_of(half, 2, true), kBlendOne / 8, 1);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(weight_of(half, k), weight_of(by_state, k) / 2.0, 2);
  }
}

TEST(PictureBlend, NearestAddsHalfToThePatternOfItsRank) {
  const Patterns patterns({0, 100, 40, 60, 20});
  const State picture = state_at(57);
  for (const Region region : kRegions) {
    std::vector<std::size_t> order = {0, 1, 2, 3, 4};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return state_distance(region, patterns.states[a], picture, 25) <
             state_distance(region, patterns.states[b], picture, 25);
    });
    const RegionBlend by_state = patterns.blend(picture, region);
    for (int rank = 0; rank < kNearestCount; ++rank) {
      const std::size_t chosen = order[std::min<std::size_t>(static_cast<std::size_t>(rank), 4)];
      const RegionBlend blend = patterns.blend(picture, region, nearest(rank));
      for (std::size_t k = 0; k < 5; ++k)
        EXPECT_NEAR(weight_of(blend, k), weight_of(by_state, k) / 2.0 + (k == chosen ? kBlendOne / 2 : 0), 3)
            << rank;
    }
  }
}

TEST(PictureBlend, EqualDistancesGoToTheLowerSlotFirst) {
  Patterns patterns({10, 10, 10});
  for (int rank = 0; rank < 3; ++rank) {
    const RegionBlend blend = patterns.blend(state_at(10), Region::kFace, nearest(rank));
    EXPECT_GT(weight_of(blend, static_cast<std::size_t>(rank)), kBlendOne / 2) << rank;
  }
}

// A pattern weighs most in its own picture, and less the farther away a picture is.
TEST(PictureBlend, PatternsOwnPictureGivesItTheMostWeight) {
  const Patterns patterns({0, 40, 80, 120, 160}, 150);
  for (const Region region : kRegions)
    for (std::size_t own = 0; own < 5; ++own) {
      const RegionBlend blend = patterns.blend(patterns.states[own], region);
      for (std::size_t k = 0; k < 5; ++k) {
        if (k != own) {
          EXPECT_GT(weight_of(blend, own), weight_of(blend, k)) << own << ' ' << k;
        }
      }
      EXPECT_GT(weight_of(blend, own), kBlendOne / 3);
    }
}

TEST(PictureBlend, ReturnsToAPatternThatIsLongPast) {
  Patterns patterns({0, 100, 200}, 0);
  patterns.states[0].control[feature(FeatureId::kMouthInner).first_control + 1].y = 1500;  // only it is open
  State picture = patterns.states[0];
  picture.picture = 190;
  EXPECT_GT(weight_of(patterns.blend(picture, Region::kMouth), 0), kBlendOne / 2);
  EXPECT_LT(weight_of(patterns.blend(picture, Region::kGround), 0), kBlendOne / 8)
      << "the ground is as it was lately";
}

// Nothing pops: weights change in small steps when the state does. By state they move faster where all
// patterns are alike, since little is left of their weights once the smallest is subtracted.
TEST(PictureBlend, WeightsAreContinuousInTime) {
  std::mt19937 random(2);
  for (int i = 0; i < 40; ++i) {
    std::vector<std::int32_t> pictures;
    for (std::int32_t p = 0; p <= 600; p += 60)
      pictures.push_back(p + static_cast<std::int32_t>(random() % 30));
    const Patterns patterns(pictures, static_cast<int>(random() % 40));
    for (const Region region : kRegions) {
      for (const BlendMode mode : {BlendMode::kByState, BlendMode::kByTime, BlendMode::kHalfStill}) {
        RegionBlend last = patterns.blend(state_at(0), region, mode);
        for (std::int32_t p = 1; p < 640; ++p) {
          State state = state_at(p);
          state.pose[kYaw] = state_at(0).pose[kYaw] + p * 10;
          RegionBlend now = patterns.blend(state, region, mode);
          if (p == 1) last = now;
          for (std::size_t k = 0; k < pictures.size(); ++k)
            for (const bool still : {false, true})
              ASSERT_NEAR(weight_of(now, k, still), weight_of(last, k, still),
                          mode == BlendMode::kByTime ? kBlendOne / 24 : kBlendOne / 3)
                  << p << " pattern " << k << " region " << static_cast<int>(region);
          last = std::move(now);
        }
      }
    }
  }
}

TEST(PictureBlend, EachRegionHasItsMode) {
  const Patterns patterns({0, 40});
  State picture = state_at(20);
  picture.blend[static_cast<std::size_t>(Region::kMouth)] = BlendMode::kStillBefore;
  picture.blend[static_cast<std::size_t>(Region::kGround)] = BlendMode::kByTime;
  const std::vector<const State*> seen = {&patterns.states[0], &patterns.states[1]};
  const PictureBlend blend = blend_picture(seen, picture);
  EXPECT_EQ(weight_of(blend[static_cast<std::size_t>(Region::kMouth)], 0, true), kBlendOne);
  EXPECT_EQ(weight_of(blend[static_cast<std::size_t>(Region::kGround)], 1), kBlendOne / 2);
  EXPECT_EQ(weight_of(blend[static_cast<std::size_t>(Region::kFace)], 0, true), 0);
}

}  // namespace
}  // namespace fbs
