#include "decoder/blend/mesh_blend.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <vector>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

std::size_t index_of(Region region) {
  return static_cast<std::size_t>(region);
}

/// A blend in which every region shows one pattern, warped.
PictureBlend all_of(std::uint8_t pattern) {
  PictureBlend blend;
  blend.fill({{{pattern, false}, kBlendOne}});
  return blend;
}

struct Case {
  Scene scene = toy_scene(Picture(160, 128), even_surround(6, 5, 2, 1));
  std::vector<TextureMesh> textures = std::vector<TextureMesh>(4, scene.patterns[0].texture);
  ScreenMesh mesh = scene.geometry->screen_mesh(scene.patterns[0].seen);  // so that all is seen as drawn
  [[nodiscard]] MeshBlend blend(const PictureBlend& picture) const {
    std::vector<const TextureMesh*> pointers;
    for (const TextureMesh& t : textures) pointers.push_back(&t);
    return blend_mesh(picture, *scene.geometry, pointers, mesh);
  }
};

void expect_rows_of_one(const PointWeights& weights, std::size_t points) {
  ASSERT_EQ(weights.weights.size(), points * weights.sources);
  for (std::size_t p = 0; p < points; ++p) {
    const auto row = weights.at(p);
    ASSERT_EQ(std::accumulate(row.begin(), row.end(), 0), kMeshWeightOne) << p;
    for (const std::int32_t w : row) ASSERT_GE(w, 0);
  }
}

/// Some sources with weights that sum to one.
RegionBlend random_region(std::mt19937& random) {
  RegionBlend out;
  std::int32_t left = kBlendOne;
  for (std::uint8_t pattern = 0; pattern < 4 && left > 0; ++pattern)
    for (const bool still : {false, true}) {
      const bool last = pattern == 3 && still;
      const auto weight = last ? left : static_cast<std::int32_t>(random() % static_cast<unsigned>(left + 1));
      if (weight > 0) out.push_back({{pattern, still}, weight});
      left -= weight;
    }
  return out;
}

TEST(MeshBlend, WeightsSumToOneAtEveryPoint) {
  std::mt19937 random(1);
  Case c;
  for (int i = 0; i < 300; ++i) {
    PictureBlend picture;
    for (RegionBlend& region : picture) region = random_region(random);
    for (TextureMesh& t : c.textures)
      for (std::int64_t& a : t.areas) a = random() % 100000;
    const MeshBlend blend = c.blend(picture);
    expect_rows_of_one(blend.head, c.scene.geometry->head_shares().size());
    const auto& shares = c.scene.geometry->surround().shares();
    expect_rows_of_one(point_weights(blend.regions, shares), shares.size());
    for (const auto& region : blend.regions)
      EXPECT_EQ(std::accumulate(region.begin(), region.end(), 0), kBlendOne);
  }
}

TEST(MeshBlend, NamesEachSourceOnce) {
  Case c;
  PictureBlend picture = all_of(2);
  picture[index_of(Region::kBody)] = {{{0, false}, 100}, {{2, true}, 156}};
  const std::vector<BlendSource> expected = {{0, false}, {2, false}, {2, true}};
  EXPECT_EQ(c.blend(picture).sources, expected);
}

TEST(MeshBlend, PointsHaveTheBlendOfTheirRegion) {
  Case c;
  PictureBlend picture = all_of(0);
  picture[index_of(Region::kMouth)] = all_of(1)[0];
  picture[index_of(Region::kGround)] = {{{0, false}, 56}, {{3, false}, 200}};
  const MeshBlend blend = c.blend(picture);
  ASSERT_EQ(blend.sources.size(), 3U);
  EXPECT_EQ(blend.head.at(vertex_of_landmark(62))[1], kMeshWeightOne) << "lips";
  EXPECT_EQ(blend.head.at(vertex_of_landmark(27))[0], kMeshWeightOne) << "nose";
  EXPECT_EQ(blend.regions[index_of(Region::kGround)][2], 200);
  const PointWeights surround = point_weights(blend.regions, c.scene.geometry->surround().shares());
  EXPECT_EQ(surround.at(0)[2], 200 * kShareOne) << "the margin is ground";
}

TEST(MeshBlend, VerticesAreTakenFromPatternsThatShowThem) {
  Case c;
  PictureBlend picture = all_of(0);
  picture.fill({{{0, false}, 64}, {{1, false}, 192}});
  const std::size_t cheek = vertex_of_landmark(2);
  std::int64_t &first = c.textures[0].areas[cheek], &second = c.textures[1].areas[cheek];
  const std::int64_t drawn = first;
  constexpr int kRounding = kMeshWeightOne / 256;  // of a visibility
  const auto weight = [&] { return c.blend(picture).head.at(cheek)[0]; };
  second = 0;
  EXPECT_EQ(weight(), kMeshWeightOne) << "hidden";
  second = drawn / 4;  // 64 against 96
  EXPECT_NEAR(weight(), kMeshWeightOne * 2 / 5, kRounding) << "shrunken";
  second = drawn / 2;
  EXPECT_NEAR(weight(), kMeshWeightOne / 4, kRounding) << "half the area is enough";
  second = 50 * drawn;
  EXPECT_EQ(weight(), kMeshWeightOne / 4) << "and more is no better";
  first = second = 0;
  EXPECT_EQ(weight(), kMeshWeightOne / 4) << "none shows it: as if all did";
  // The sum of 2048 triangles as large as the screen allows.
  c.mesh.areas[cheek] = first = std::int64_t{1} << 55;
  second = std::int64_t{1} << 53;  // 64 against 96
  EXPECT_NEAR(weight(), kMeshWeightOne * 2 / 5, kRounding) << "large";
}

// A cheek that is turned away is best taken from a picture in which it was turned away as far.
TEST(MeshBlend, VerticesThatAreHardlyDrawnNeedNotBeSeenWell) {
  Case c;
  PictureBlend picture = all_of(0);
  picture.fill({{{0, false}, 64}, {{1, false}, 192}});
  const std::size_t cheek = vertex_of_landmark(2);
  c.textures[1].areas[cheek] = c.mesh.areas[cheek] = c.mesh.areas[cheek] / 10;
  EXPECT_EQ(c.blend(picture).head.at(cheek)[0], kMeshWeightOne / 4);
  c.textures[0].areas[cheek] = c.textures[1].areas[cheek] = c.mesh.areas[cheek] = 0;
  EXPECT_EQ(c.blend(picture).head.at(cheek)[0], kMeshWeightOne / 4);
}

// Unwarped sources show what is there.
TEST(MeshBlend, StillSourcesAreAlwaysVisible) {
  Case c;
  PictureBlend picture;
  picture.fill({{{0, false}, 128}, {{1, true}, 128}});
  for (TextureMesh& t : c.textures) std::fill(t.areas.begin(), t.areas.end(), 0);
  const MeshBlend blend = c.blend(picture);
  for (std::size_t v = 0; v < kVertexCount; ++v) ASSERT_EQ(blend.head.at(v)[1], kMeshWeightOne);
}

TEST(ScreenMesh, AreasOfVerticesAreWhatFacesTheViewer) {
  const Scene scene = toy_scene(Picture(160, 128));
  const auto area = [&](int yaw, std::size_t vertex) {
    State state = toy_state();
    state.pose[kYaw] = yaw;
    const ScreenMesh mesh = scene.geometry->screen_mesh(state);
    EXPECT_EQ(mesh.areas, scene.geometry->texture_mesh(state).areas);
    return mesh.areas[vertex];
  };
  const std::size_t right = vertex_of_landmark(36), left = vertex_of_landmark(45);  // corners of the eyes
  EXPECT_GT(area(0, right), 0);
  EXPECT_GT(area(0, left), 0);
  const int far = 15000;  // 82 degrees
  const bool hides_right = area(far, right) < area(far, left);
  const std::size_t hidden = hides_right ? right : left, shown = hides_right ? left : right;
  EXPECT_EQ(area(far, hidden), 0);
  EXPECT_GT(area(far, shown), 0);
  EXPECT_EQ(area(-far, shown), 0);
  EXPECT_EQ(area(0, kVertexCount), 0) << "the ring is not of the face";
}

}  // namespace
}  // namespace fbs
