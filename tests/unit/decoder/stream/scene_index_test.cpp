#include "decoder/stream/scene_index.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs {
namespace {

/// A face, nobody, a face.
const Writer& three_scenes() {
  static const Writer w = [] {
    Writer s;
    s.scene({}, 5);
    s.setup(setup_at({5, 15000})).pattern().motion(0, 4, true, {9000, 1, 1, 1});
    s.scene({9, 24003}, 5).end(14);
    return s;
  }();
  return w;
}

std::vector<std::uint64_t> offsets_of(std::span<const SceneEntry> scenes) {
  std::vector<std::uint64_t> out;
  for (const SceneEntry& scene : scenes) out.push_back(scene.offset);
  return out;
}

TEST(SceneIndex, ListsEveryScene) {
  const auto& b = three_scenes().begins;
  const auto scenes = index_scenes(three_scenes().bytes);
  ASSERT_EQ(scenes.size(), 3U);
  EXPECT_EQ(offsets_of(scenes), (std::vector<std::uint64_t>{b[0], b[5], b[8]}));
  EXPECT_EQ(scenes[1].before, (StreamPosition{5, 15000}));
  EXPECT_EQ(scenes[0].bytes, b[5] - b[0]);
  EXPECT_EQ(scenes[2].bytes, b[13] - b[8]) << "without the end packet";
  EXPECT_TRUE(scenes[0].face);
  EXPECT_FALSE(scenes[1].face);
  EXPECT_TRUE(scenes[2].face);
}

TEST(SceneIndex, SkipsDamage) {
  const auto& b = three_scenes().begins;
  for (const std::size_t damaged : {5U, 6U}) {
    Bytes bytes = three_scenes().bytes;
    bytes[b[damaged] + 4] ^= 3;
    const auto scenes = index_scenes(bytes);
    ASSERT_EQ(scenes.size(), damaged == 5 ? 2U : 3U);
    EXPECT_EQ(scenes.front().bytes, (damaged == 5 ? b[8] : b[5]) - b[0]);
    EXPECT_EQ(scenes.back().offset, b[8]);
  }
  EXPECT_TRUE(index_scenes({}).empty());
  EXPECT_TRUE(index_scenes(Bytes(1000, 7)).empty());
  EXPECT_EQ(index_scenes(std::span(three_scenes().bytes).first(b[12])).size(), 3U) << "cut";
}

TEST(SceneIndex, LeavesOutScenesThatGoBack) {
  Writer w;
  w.scene({}, 5).scene({5, 15000}, 5).scene({2, 6000}, 5).scene({10, 30000}, 5);
  EXPECT_EQ(offsets_of(index_scenes(w.bytes)),
            (std::vector<std::uint64_t>{w.begins[0], w.begins[5], w.begins[15]}));
}

TEST(SceneIndex, FindsTheLastSceneThatBeginsInTime) {
  const auto scenes = index_scenes(three_scenes().bytes);
  for (const auto& [time, scene] : std::vector<std::pair<std::uint64_t, std::size_t>>{
           {0, 0}, {14999, 0}, {15000, 1}, {24002, 1}, {24003, 2}, {kMaxStreamTime, 2}})
    EXPECT_EQ(scene_at(scenes, time), &scenes[scene]) << time;
  EXPECT_EQ(scene_at({}, 5), nullptr);
  const auto joined = std::span(scenes).subspan(1);
  EXPECT_EQ(scene_at(joined, 0), joined.data()) << "nothing begins earlier";
}

TEST(SceneIndex, PicturesFromASceneOnAreThoseOfTheWholeStream) {
  const Played whole = played(three_scenes().bytes);
  for (const SceneEntry& scene : index_scenes(three_scenes().bytes)) {
    Bytes bytes(kSignature.begin(), kSignature.end());
    bytes.insert(bytes.end(), three_scenes().bytes.begin() + static_cast<std::ptrdiff_t>(scene.offset),
                 three_scenes().bytes.end());
    const Played part = played(bytes);
    EXPECT_TRUE(part.errors.empty());
    const auto skipped = static_cast<std::ptrdiff_t>(scene.before.pictures);
    EXPECT_EQ(part.pictures, std::vector(whole.pictures.begin() + skipped, whole.pictures.end()));
    EXPECT_EQ(part.positions, std::vector(whole.positions.begin() + skipped, whole.positions.end()));
  }
}

// SPEC 6.6
TEST(SceneIndex, KnowsReturnsAndWhereAStreamCanBeJoined) {
  Writer w;
  fbs::Setup nobody = setup_at({5, 15000});
  nobody.keeps = SceneKeeping::kAndPresent;
  w.scene({}, 5).setup(nobody).pattern().motion(0, 5, true);
  w.go_back(0, {10, 30000}).motion(5, 10).go_back(1, {15, 45000}).motion(5, 10).scene({20, 60000}, 5).end(25);
  const auto scenes = index_scenes(w.bytes);
  ASSERT_EQ(scenes.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(scenes[k].before, (StreamPosition{5 * k, 15000 * k})) << k;
    EXPECT_EQ(scenes[k].face, k % 2 == 0) << k;
    EXPECT_EQ(scenes[k].is_return, k == 2 || k == 3) << k;
    EXPECT_EQ(scenes[k].is_joinable, k == 0 || k == 4) << k;
    if (k > 0) {
      EXPECT_EQ(scenes[k].offset, scenes[k - 1].offset + scenes[k - 1].bytes) << k;
    }
  }
  EXPECT_EQ(scene_at(scenes, 59999), &scenes[0]);
  EXPECT_EQ(scene_at(scenes, 60000), &scenes[4]);
  EXPECT_EQ(scene_at(std::span(scenes).subspan(1), 0), &scenes[4]);
  EXPECT_EQ(scene_at(std::span(scenes).subspan(1, 3), 0), nullptr);
}

}  // namespace
}  // namespace fbs
