#include "decoder/draw/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "decoder/head/head_mesh.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kWidth = 160, kHeight = 128;

/// Stripes of a width that softening changes everywhere.
Plane stripes() {
  Plane out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) out.row(y)[x] = (x + y) % 4 < 2 ? 200 : 40;
  return out;
}

/// The plane with the silhouettes of a toy head softened, as if every sample had this depth.
/// @param warped  weight of the warped sources
Plane softened(Plane plane, std::int32_t yaw, std::int32_t depth, std::int32_t warped = kMeshWeightOne) {
  const Scene scene = toy_scene(Picture(kWidth, kHeight), even_surround(6, 6, 2));
  State state = toy_state();
  state.pose[kYaw] = yaw;
  const SampleArea area{0, 0, kWidth, kHeight};
  DepthPlane depths;
  depths.reset(kWidth, kHeight, area);
  std::fill(depths.depth.begin(), depths.depth.end(), depth);
  const PlaneView view(plane);
  HeadWeights weights;
  weights.screen = {1, std::vector(scene.geometry->head_mesh().vertex_count, warped)};
  soften_silhouettes(scene.geometry->screen_mesh(state), scene.geometry->head_mesh(), weights,
                     PlaneScale::kLuma, depths, {&view, 1});
  return plane;
}

int differences(const Plane& a, const Plane& b) {
  int count = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) count += a.row(y)[x] != b.row(y)[x] ? 1 : 0;
  return count;
}

constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::max();  ///< is drawn
constexpr std::int32_t kTurned = 9000;                                       ///< 50 degrees

TEST(Silhouette, OfATurnedHeadIsSoftenedAndOfOneInFrontLess) {
  const int turned = differences(softened(stripes(), kTurned, kNothing), stripes());
  const int frontal = differences(softened(stripes(), 0, kNothing), stripes());
  EXPECT_GT(turned, 50);
  EXPECT_LT(turned, kWidth * kHeight / 10) << "it is a narrow band";
  EXPECT_LT(frontal, turned);
}

TEST(Silhouette, ThatIsHiddenIsLeftAlone) {
  EXPECT_EQ(softened(stripes(), kTurned, std::numeric_limits<std::int32_t>::min()), stripes());
}

TEST(Silhouette, ThatHidesNothingFarBehindIsLeftAlone) {
  const Scene scene = toy_scene(Picture(kWidth, kHeight), even_surround(6, 6, 2));
  State state = toy_state();
  state.pose[kYaw] = kTurned;
  std::int32_t nearest = kNothing;
  for (const glm::ivec3& v : scene.geometry->screen_mesh(state).head) nearest = std::min(nearest, v.z);
  EXPECT_EQ(softened(stripes(), kTurned, nearest), stripes());
}

TEST(Silhouette, ThatStillSourcesShowIsLeftAlone) {
  EXPECT_EQ(softened(stripes(), kTurned, kNothing, 0), stripes());
}

TEST(Silhouette, LeavesAnEvenPictureAsItIs) {
  const Plane even(kWidth, kHeight, 77);
  EXPECT_EQ(softened(even, kTurned, kNothing), even);
}

}  // namespace
}  // namespace fbs
