#include "decoder/head/head_deformation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(Deform, NeutralStateLeavesTheHeadAlone) {
  const Geometry neutral = toy_geometry();
  EXPECT_EQ(deform(neutral, State{}), neutral.positions);
}

TEST(Deform, AddsEachControlPointByItsWeight) {
  std::mt19937 random(3);
  const auto neutral = toy_geometry().positions;
  State state;
  for (glm::ivec2& c : state.control)
    c = {static_cast<int>(random() % 1501) - 750, static_cast<int>(random() % 1501) - 750};
  const auto moved = deform(toy_geometry(), state);
  const GenericHead& head = generic_head();
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (head.vertices[v].feature >= static_cast<int>(FeatureId::kPupilRight))
      continue;  // kept between the lids
    glm::dvec2 offset(0);
    for (std::size_t k = head.skinning_begin[v]; k < head.skinning_begin[v + 1]; ++k)
      offset += glm::dvec2(state.control[head.skinning[k].control]) *
                (head.skinning[k].weight / static_cast<double>(kSkinningOne));
    EXPECT_NEAR(moved[v].x - neutral[v].x, offset.x, 0.501);
    EXPECT_NEAR(moved[v].y - neutral[v].y, offset.y, 0.501);
    EXPECT_EQ(moved[v].z, neutral[v].z);
  }
}

// Lids that shut or cross would fold the triangles of the eye.
TEST(Deform, KeepsPupilsBetweenTheLids) {
  std::mt19937 random(4);
  int shut = 0;
  for (int i = 0; i < 500; ++i) {
    State state;
    for (glm::ivec2& c : state.control) c = {0, static_cast<int>(random() % 2001) - 1000};
    const auto vertices = deform(toy_geometry(), state);
    const auto y_of = [&](FeatureId id) {
      std::vector<int> y;
      for (const FeatureVertex& v : feature(id).vertices) y.push_back(vertices[v.vertex].y);
      return y;
    };
    const auto upper = y_of(FeatureId::kUpperLidLeft), lower = y_of(FeatureId::kLowerLidLeft);
    const int low = *std::max_element(upper.begin(), upper.end()),
              high = *std::min_element(lower.begin(), lower.end());
    const int pupil = y_of(FeatureId::kPupilLeft).front();
    if (low >= high) ++shut;
    ASSERT_TRUE(pupil >= std::min(low, high) && pupil <= std::max(low, high)) << i;
  }
  EXPECT_TRUE(shut > 20 && shut < 480) << "both cases must occur";
}

}  // namespace
}  // namespace fbs
