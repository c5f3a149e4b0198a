#include "encoder/surround/similarity_alignment.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/surround/painted_surround.h"

namespace fbs {
namespace {

constexpr int kFactor = 2;

SurroundPyramid pyramid_of(const Picture& picture) {
  return make_pyramid<kSurroundLevels>(reduced(picture.y, kFactor));
}

/// Keypoints of the first picture, all of them ground, against a picture in which the ground has moved.
struct Aligned {
  std::vector<Keypoint> keypoints =
      select_keypoints(pyramid_of(picture_of({}, 0, false)), kFactor, pose_of(seen_state()));
  SurroundPyramid now;
  SimilarityAlignment alignment;

  explicit Aligned(const Similarity& ground)
      : now(pyramid_of(picture_of({{}, {}, ground}, 0, false))), alignment(keypoints, now, kFactor, kEyePx) {
    for (Keypoint& k : keypoints) k.layers = LayerMembership(LayerShares{0, 0, 1});
  }
};

TEST(SimilarityAlignment, FindsASimilarityFromRest) {
  for (const Similarity& by : {Similarity{2.4, -1.3, 0, 0}, {0, 0, 0.5, 0}, {1, 0.5, -0.3, 0.4}}) {
    const Aligned a(by);
    const Similarity found = a.alignment.align(kGroundLayer, {}, {});
    for (std::size_t i = 0; i < kSimilarityCount; ++i) EXPECT_NEAR(found[i], by[i], 0.1) << i;
    EXPECT_LT(a.alignment.cost(kGroundLayer, found), 0.2 * a.alignment.cost(kGroundLayer, {}));
  }
}

TEST(SimilarityAlignment, WithoutKeypointsStaysWhereItStarts) {
  const Aligned a({2, 0, 0, 0});
  const Similarity start = {1, 2, 0, 0};
  const Similarity found = a.alignment.align(kBodyLayer, start, start);  // no keypoint is body
  for (std::size_t i = 0; i < kSimilarityCount; ++i) EXPECT_NEAR(found[i], start[i], 1e-9) << i;
  EXPECT_EQ(a.alignment.cost(kBodyLayer, start), 0);
}

TEST(SimilarityAlignment, WithoutKeypointsThePriorDecides) {
  const Aligned a({2, 0, 0, 0});
  const Similarity prior = {1, 2, 0.1, 0};
  const Similarity found = a.alignment.align(kBodyLayer, {}, prior);
  for (std::size_t i = 0; i < kSimilarityCount; ++i) EXPECT_NEAR(found[i], prior[i], 1e-9) << i;
}

TEST(SimilarityAlignment, CostOfTheRimIsThatOfItsKeypoints) {
  Aligned a({2, 0, 0, 0});
  const double rim = a.alignment.cost(kGroundLayer, {}, true);
  EXPECT_GT(rim, 0);
  EXPECT_NE(rim, a.alignment.cost(kGroundLayer, {}));
  for (Keypoint& k : a.keypoints) k.rim_piece = -1;
  EXPECT_EQ(a.alignment.cost(kGroundLayer, {}, true), 0);
}

}  // namespace
}  // namespace fbs
