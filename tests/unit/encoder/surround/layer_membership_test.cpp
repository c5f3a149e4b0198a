#include "encoder/surround/layer_membership.h"

#include <gtest/gtest.h>

#include <cmath>

#include "encoder/surround/map_grid.h"
#include "tests/unit/encoder/surround/painted_surround.h"

namespace fbs {
namespace {

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

TEST(LayersByMap, InterpolateBetweenItsPoints) {
  SurroundMap map = uniform_map({2, 2}, {0, kFollowOne});
  map.head[4] = kFollowOne;  // the middle goes with the head
  map.body[4] = 0;
  EXPECT_EQ(layers_by_map(map, {0.5, 0.5}), (LayerShares{1, 0, 0}));
  EXPECT_EQ(layers_by_map(map, {0, 0}), (LayerShares{0, 1, 0}));
  EXPECT_EQ(layers_by_map(map, {0.25, 0.5}), (LayerShares{0.5F, 0.5F, 0}));
  EXPECT_EQ(layers_by_map(map, {7, -3}), (LayerShares{0, 1, 0})) << "outside, the border is repeated";
}

double sum_of(const LayerShares& l) {
  return static_cast<double>(l[0]) + static_cast<double>(l[1]) + static_cast<double>(l[2]);
}

TEST(LayerMembership, StartsFromThePrior) {
  const LayerMembership m(LayerShares{0.1F, 0.6F, 0.3F});
  for (std::size_t l = 0; l < kLayerCount; ++l) EXPECT_NEAR(m.weight()[l], m.prior()[l], 1e-6);
}

// The prior says body; what the ground's motion explains picture after picture becomes ground.
TEST(LayerMembership, ResidualsOutweighThePrior) {
  LayerMembership m(LayerShares{0.1F, 0.6F, 0.3F});
  for (int i = 0; i < 10; ++i) {
    m.observe(kHeadLayer, 30, 1.0F / static_cast<float>(i + 1));
    m.observe(kBodyLayer, 20, 1.0F / static_cast<float>(i + 1));
    m.observe(kGroundLayer, 2, 1.0F / static_cast<float>(i + 1));
    m.update();
  }
  EXPECT_GT(m.weight(kGroundLayer), 0.9);
  EXPECT_NEAR(sum_of(m.weight()), 1, 1e-5);
  EXPECT_EQ(m.share()[kBodyLayer], 0.6F) << "what the decoder moves does not change";
}

TEST(LayerMembership, WhatIsHiddenSaysNothing) {
  LayerMembership m(LayerShares{0.2F, 0.2F, 0.6F});
  const LayerShares before = m.weight();
  for (const Layer layer : {kHeadLayer, kBodyLayer, kGroundLayer}) m.observe_hidden(layer);
  m.update();
  EXPECT_EQ(m.weight(), before);
  EXPECT_EQ(m.visible(), (LayerShares{0, 0, 0}));
}

TEST(LayerMembership, VisibleFallsWithTheResidual) {
  LayerMembership m(LayerShares{0, 0, 1});
  m.observe(kGroundLayer, 0, 1);
  EXPECT_EQ(m.visible()[kGroundLayer], 1);
  m.observe(kGroundLayer, 60, 1);
  EXPECT_LT(m.visible()[kGroundLayer], 0.01F);
}

TEST(LayerMembership, AMapReplacesThePriorAndKeepsWhatWasLearned) {
  LayerMembership m(LayerShares{0, 1, 0});
  m.observe(kGroundLayer, 0, 1);
  m.observe(kBodyLayer, 25, 1);
  m.set_map({0, 0.5F, 0.5F});
  EXPECT_EQ(m.share(), (LayerShares{0, 0.5F, 0.5F}));
  EXPECT_GT(m.weight(kGroundLayer), 0.8);
}

}  // namespace
}  // namespace fbs
