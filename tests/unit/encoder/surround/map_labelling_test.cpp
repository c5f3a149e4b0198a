#include "encoder/surround/map_labelling.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/surround/painted_surround.h"

namespace fbs {
namespace {

constexpr MapGrid kGrid{8, 6};

std::vector<MapLabel> solved(const SurroundObservations& observations, std::vector<glm::dvec2> prior) {
  const CellCost cost(toy_setup(kWidth, kHeight), toy_geometry(), kGrid, observations);
  return MapLabelling(kGrid, cost, std::move(prior)).solve();
}

std::vector<glm::dvec2> even_prior(glm::dvec2 shares) {
  return std::vector(kGrid.points(), shares);
}

SurroundObservations first_only() {
  SurroundObservations out(toy_setup(kWidth, kHeight).format);
  out.set_first(picture_of({}), seen_state());
  return out;
}

TEST(MapLabelling, FollowsThePriorWithoutLaterPictures) {
  for (const MapLabel& label : map_labels())
    for (const MapLabel& found : solved(first_only(), even_prior({label.head, label.body})))
      EXPECT_EQ(found, label);
}

// One point's odd prior costs less than its four differences from its neighbours.
TEST(MapLabelling, SmoothsASinglePointAway) {
  auto prior = even_prior({0, 0});
  prior[3 * kGrid.stride() + 4] = {kFollowOne, 0};
  for (const MapLabel& found : solved(first_only(), prior)) EXPECT_EQ(found, MapLabel{});
}

// The ground has moved and the body has not: the prior "body" is given up.
TEST(MapLabelling, PicturesOverruleThePrior) {
  SurroundObservations observations = first_only();
  const Similarity ground = {7, 3, 0, 0};
  State now = seen_state();
  for (std::size_t i = 0; i < kSimilarityCount; ++i) now.ground[i] = to_state(ground[i]);
  observations.add(picture_of({{}, {}, ground}), now);
  const auto labels = solved(observations, even_prior({0, kFollowOne}));
  for (const std::size_t k : {kGrid.stride() + 1, kGrid.stride() + 7, 3 * kGrid.stride() + 1})
    EXPECT_EQ(labels[k], MapLabel{}) << k;
}

}  // namespace
}  // namespace fbs
