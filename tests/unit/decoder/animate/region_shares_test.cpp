#include "decoder/animate/region_shares.h"

#include <gtest/gtest.h>

#include <numeric>

#include "bitstream/syntax.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

int sum_of(const RegionShares& shares) {
  return std::accumulate(shares.begin(), shares.end(), 0);
}

std::uint8_t share(const RegionShares& shares, Region region) {
  return shares[static_cast<std::size_t>(region)];
}

TEST(VertexShares, SumToOne) {
  for (const RegionShares& shares : vertex_shares(generic_head())) EXPECT_EQ(sum_of(shares), kShareOne);
}

TEST(VertexShares, AreOfTheHeadsRegions) {
  for (const RegionShares& shares : vertex_shares(generic_head()))
    for (const Region region : {Region::kHair, Region::kBody, Region::kGround})
      EXPECT_EQ(share(shares, region), 0);
}

TEST(VertexShares, FeaturesBelongToTheirRegion) {
  const auto of_landmark = [](std::size_t landmark) {
    return vertex_shares(generic_head())[vertex_of_landmark(landmark)];
  };
  for (const std::size_t lip : {51, 57, 62, 66})
    EXPECT_EQ(share(of_landmark(lip), Region::kMouth), kShareOne) << lip;
  for (const std::size_t lid : {37, 38, 40, 41})
    EXPECT_GT(share(of_landmark(lid), Region::kRightEye), 0) << lid;
  for (const std::size_t lid : {43, 44, 46, 47})
    EXPECT_GT(share(of_landmark(lid), Region::kLeftEye), 0) << lid;
  for (const std::size_t other : {27, 19, 24, 0, 16})
    EXPECT_EQ(share(of_landmark(other), Region::kFace), kShareOne);
}

TEST(SurroundShares, SumToOneForAllWeights) {
  for (int head = 0; head <= kFollowOne; ++head)
    for (int body = 0; body <= kFollowOne; ++body) EXPECT_EQ(sum_of(surround_shares(head, body)), kShareOne);
}

TEST(SurroundShares, FollowTheMapsLayers) {
  EXPECT_EQ(share(surround_shares(kFollowOne, 0), Region::kHair), kShareOne);
  EXPECT_EQ(share(surround_shares(0, kFollowOne), Region::kBody), kShareOne);
  EXPECT_EQ(share(surround_shares(0, 0), Region::kGround), kShareOne);
  const RegionShares mixed = surround_shares(1, 2);  // a quarter; half of the rest
  EXPECT_EQ(share(mixed, Region::kHair), kShareOne / 4);
  EXPECT_EQ(share(mixed, Region::kBody), 3 * kShareOne / 8);
}

// Points of the ring lie between grid points.
TEST(HeadShares, SumToOneOnTheRingToo) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    SurroundMap map = even_surround(7, 6, 0);
    for (std::uint8_t& h : map.head) h = static_cast<std::uint8_t>(random() % (kFollowOne + 1));
    for (std::size_t k = 0; k < map.body.size(); ++k)
      map.body[k] = map.head[k] == kFollowOne ? 0 : static_cast<std::uint8_t>(random() % (kFollowOne + 1));
    const Scene scene = toy_scene(Picture(160, 128), map);
    for (const RegionShares& shares : scene.geometry->head_shares()) EXPECT_EQ(sum_of(shares), kShareOne);
    for (const RegionShares& shares : scene.geometry->surround().shares())
      EXPECT_EQ(sum_of(shares), kShareOne);
  }
}

}  // namespace
}  // namespace fbs
