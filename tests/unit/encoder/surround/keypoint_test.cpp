#include "encoder/surround/keypoint.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/surround/painted_surround.h"

namespace fbs {
namespace {

constexpr int kFactor = 2;

std::vector<Keypoint> keypoints_of(const Picture& picture) {
  return select_keypoints(make_pyramid<kSurroundLevels>(reduced(picture.y, kFactor)), kFactor,
                          pose_of(seen_state()));
}

Picture even_wall() {
  Picture wall(kWidth, kHeight);
  for (auto& s : wall.y.samples) s = 90;
  return wall;
}

TEST(Keypoints, NoneOnAnEvenWall) {
  EXPECT_TRUE(keypoints_of(even_wall()).empty());
}

TEST(Keypoints, LieOnAnEdgeAndHaveItsSlope) {
  Picture picture = even_wall();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 40; x < kWidth; ++x) picture.y.row(y)[x] = 190;
  const std::vector<Keypoint> keypoints = keypoints_of(picture);
  ASSERT_GT(keypoints.size(), 10U);
  for (const Keypoint& k : keypoints) {
    EXPECT_NEAR(k.place.x, 40, 2 * kFactor);
    EXPECT_EQ(k.place, (k.at + 0.5) * static_cast<double>(kFactor));
    EXPECT_GT(k.seen[0].dx, 20);
    EXPECT_EQ(k.seen[0].dy, 0);
    EXPECT_GT(k.structure[0], 0);
    EXPECT_EQ(k.structure[2], 0) << "nothing slopes downwards";
  }
}

TEST(Keypoints, OneASquareAndNoneUnderTheHead) {
  const std::vector<Keypoint> keypoints = keypoints_of(picture_of({}));
  ASSERT_GT(keypoints.size(), 400U);
  std::vector<std::pair<int, int>> squares;
  for (const Keypoint& k : keypoints) {
    EXPECT_LE(k.layers.prior()[kHeadLayer], 0.99F);
    EXPECT_GT(std::hypot(k.from_head.x, k.from_head.y), 1);
    squares.emplace_back(k.quarters[0].at.x, k.quarters[0].at.y);
    EXPECT_GE(k.at.x, k.quarters[0].at.x);
    EXPECT_LT(k.at.x, k.quarters[0].at.x + 4);
  }
  std::sort(squares.begin(), squares.end());
  EXPECT_EQ(std::adjacent_find(squares.begin(), squares.end()), squares.end());
}

TEST(Keypoints, RimIsAtTheSidesAndTheTop) {
  for (const Keypoint& k : keypoints_of(picture_of({}))) {
    const double u = k.place.x / kWidth, v = k.place.y / kHeight;
    if (!k.on_rim()) continue;
    EXPECT_TRUE(v < 0.18 || (v < 0.76 && (u < 0.18 || u > 0.82))) << u << ' ' << v;
    EXPECT_LT(k.rim_piece, 10);
    EXPECT_EQ(k.rim_piece < 4, v < 0.17) << "the first four are the top's";
  }
}

TEST(GroundShows, WhereTheRimHasTexture) {
  EXPECT_TRUE(ground_shows(keypoints_of(picture_of({}))));
  EXPECT_FALSE(ground_shows({}));
  // Texture in the lower half of the left side alone.
  Picture picture = even_wall();
  const Picture painted = picture_of({});
  for (int y = 100; y < 160; ++y) std::copy_n(painted.y.row(y), 50, picture.y.row(y));
  const std::vector<Keypoint> few = keypoints_of(picture);
  ASSERT_FALSE(few.empty());
  EXPECT_FALSE(ground_shows(few));
}

}  // namespace
}  // namespace fbs
