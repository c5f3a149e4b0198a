#include "encoder/surround/surround_learning.h"

#include <gtest/gtest.h>

#include "decoder/animate/surround.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

Picture picture() {
  return picture_of(smooth_plane, 160, 128, 1);
}

SurroundLearning learning(bool still, bool keeps) {
  SurroundObservations first(toy_setup().format);
  first.set_first(picture(), toy_state());
  return {std::move(first), still, keeps};
}

SurroundMap fitted(SurroundLearning& surround) {
  surround.fit(toy_setup(), toy_geometry());
  return surround.map();
}

TEST(SurroundLearning, TheMapIsGivenOnceAfterEachFit) {
  SurroundLearning surround = learning(false, false);
  EXPECT_FALSE(surround.take_new_map());
  const SurroundMap map = fitted(surround);
  EXPECT_GT(map.columns, 0);
  EXPECT_EQ(surround.take_new_map(), map);
  EXPECT_FALSE(surround.take_new_map());
}

TEST(SurroundLearning, AStillSurroundLearnsNothing) {
  SurroundLearning surround = learning(true, false);
  surround.add(noise_picture(160, 128, 5), toy_state(90));
  EXPECT_EQ(fitted(surround), still_surround());
}

TEST(SurroundLearning, ALiveSceneKeepsTheMapUntilItHasSeenMore) {
  for (const bool keeps : {false, true}) {
    SurroundLearning surround = learning(false, keeps);
    for (int t = 1; t < 6; ++t) surround.add(picture(), toy_state(80 + 4 * t));
    const SurroundMap map = fitted(surround);
    surround.end(toy_setup().format);
    EXPECT_TRUE(surround.has_ended());
    surround.begin_again(picture(), toy_state());
    EXPECT_FALSE(surround.has_ended());
    EXPECT_EQ(fitted(surround) == map, keeps);
  }
}

}  // namespace
}  // namespace fbs
