#include "encoder/scene/still_scene.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/decoded_packets.h"
#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {
namespace {

std::unique_ptr<SceneEncoder> begun(const Picture& first) {
  EncoderSettings settings;
  settings.group_pictures = 4;
  auto scene = StillScene::begin(format_of(first.width(), first.height()), settings, first);
  EXPECT_TRUE(scene);
  return std::move(*scene);
}

TEST(StillScene, ShowsItsFirstPictureAsLongAsItLasts) {
  const Picture first = scenery(96, 80);
  const auto scene = begun(first);
  for (int t = 0; t < 11; ++t)
    ASSERT_TRUE(scene->push(t == 0 ? first : scenery(96, 80, 40), t == 5 ? 9000 : 0));
  ASSERT_TRUE(scene->finish());
  const Shown shown = shown_by(scene->take());
  ASSERT_EQ(shown.pictures.size(), 11U);
  for (const Picture& p : shown.pictures) EXPECT_EQ(p, shown.pictures.front());
  EXPECT_GT(squared_error(shown.pictures.front().y, first.y).psnr(), 30);
  EXPECT_EQ(shown.durations[5], 9000U);
  EXPECT_EQ(shown.durations[6], 3600U) << "of 25 pictures a second";
}

TEST(StillScene, HoldsNothingBackButTheGroup) {
  const Picture first = scenery(96, 80);
  const auto scene = begun(first);
  EXPECT_FALSE(scene->take().empty()) << "setup and pattern";
  ASSERT_TRUE(scene->push(first, 0));
  EXPECT_FALSE(scene->take().empty()) << "the first picture is a group of its own";
  ASSERT_TRUE(scene->push(first, 0));
  EXPECT_TRUE(scene->take().empty());
}

TEST(StillScene, HasNoFace) {
  const auto scene = begun(scenery(96, 80));
  ASSERT_TRUE(scene->push(scenery(96, 80), 0));
  EXPECT_FALSE(scene->analysis().face);
}

}  // namespace
}  // namespace fbs
