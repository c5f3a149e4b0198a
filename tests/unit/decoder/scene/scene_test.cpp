#include "decoder/scene/scene.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

SceneGeometry geometry_of(int follow) {
  return {toy_setup(), toy_geometry(), even_surround(6, 5, follow), toy_state()};
}

bool same(const TextureMesh& a, const TextureMesh& b) {
  return a.head == b.head && a.surround == b.surround && a.light == b.light && a.mouth_gap == b.mouth_gap &&
         a.areas == b.areas;
}

TEST(MakePattern, TakesItsTextureFromTheSeenState) {
  std::mt19937 random(1);
  const std::optional<SceneGeometry> geometry = geometry_of(3);
  const Picture picture = noise_picture(160, 128, 2);
  for (int i = 0; i < 10; ++i) {
    const State seen = random_state(random);
    const Pattern pattern = make_pattern(picture, seen, geometry);
    EXPECT_EQ(pattern.picture, picture);
    EXPECT_EQ(pattern.seen, seen);
    EXPECT_TRUE(same(pattern.texture, geometry->texture_mesh(seen)));
  }
}

TEST(MakePattern, HasNoTextureMeshWithoutAFace) {
  const Pattern pattern = make_pattern(noise_picture(160, 128, 3), toy_state(), std::nullopt);
  EXPECT_TRUE(same(pattern.texture, TextureMesh{}));
}

TEST(Scene, NewGeometryRenewsTheTextureOfEveryPattern) {
  State other = toy_state(90, 60);
  other.pose[kYaw] = 2000;
  Scene scene = toy_scene(noise_picture(160, 128, 4), even_surround(6, 5, 0));
  scene.patterns.push_back(make_pattern(noise_picture(160, 128, 5), other, scene.geometry));
  const Scene before = scene;
  scene.set_geometry(geometry_of(kFollowOne));
  EXPECT_FALSE(same(scene.patterns[1].texture, before.patterns[1].texture)) << "the case must occur";
  for (const Pattern& p : scene.patterns) EXPECT_TRUE(same(p.texture, scene.geometry->texture_mesh(p.seen)));
}

TEST(Scene, StoresPatternsBySlotWhateverIsMissingBetweenThem) {
  Scene scene = toy_scene(noise_picture(160, 128, 1));
  const auto store = [&](std::int32_t slot, std::int32_t picture) {
    Pattern pattern = scene.patterns.front();
    pattern.slot = slot;
    pattern.seen.picture = picture;
    scene.patterns.store(std::move(pattern));
  };
  const auto stored = [&] {
    std::vector<std::pair<int, int>> out;
    for (const Pattern& p : scene.patterns) out.emplace_back(p.slot, p.seen.picture);
    return out;
  };
  using Stored = std::vector<std::pair<int, int>>;
  store(5, 7);
  store(2, 8);
  EXPECT_EQ(stored(), (Stored{{0, 0}, {2, 8}, {5, 7}}));
  store(5, 9);
  store(0, 10);
  store(6, 11);
  EXPECT_EQ(stored(), (Stored{{0, 10}, {2, 8}, {5, 9}, {6, 11}}));
}

}  // namespace
}  // namespace fbs
