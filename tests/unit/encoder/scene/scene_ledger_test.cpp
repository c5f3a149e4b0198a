#include "encoder/scene/scene_ledger.h"

#include <gtest/gtest.h>

#include "encoder/segment/pass_settings.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kFps = 10;

Setup setup() {
  Setup out = toy_setup();
  out.format.frame_rate = {kFps, 1};
  return out;
}

EncoderSettings settings(double key_interval, bool live) {
  EncoderSettings out;
  out.key_interval = key_interval;
  if (live) out.live.emplace().delay = 0.2;
  return out;
}

SceneLedger ledger(const EncoderSettings& settings, bool several) {
  const RatePlan rate{OperatingPoint::at(50, 32), 0};
  const CodedState rest = coded_pose(toy_state());
  return {
      setup(), rest, rate, settings,
      several ? pattern_stage(pass_settings(settings, rate.point), settings, setup().format, rest) : nullptr};
}

/// Adds pictures, and ends groups where they end.
/// @param duration  of each picture, 1/90000 s; 0: nominal
/// @return pictures of each
std::vector<std::size_t> groups(SceneLedger& scene, int pictures, std::uint32_t duration = 0) {
  std::vector<std::size_t> out;
  for (int t = 0; t < pictures; ++t) {
    EXPECT_TRUE(scene.add(noise_picture(160, 128, 1), duration));
    if (scene.group_ends()) out.push_back(scene.end_group().size());
  }
  return out;
}

TEST(SceneLedger, TheFirstPictureIsAGroupOfItsOwn) {
  SceneLedger scene = ledger({}, false);
  EXPECT_EQ(groups(scene, 25), (std::vector<std::size_t>{1, 10, 10}));
  EXPECT_TRUE(scene.in_group());
  EXPECT_EQ(scene.end_group().size(), 4U);
}

TEST(SceneLedger, TimeEndsLiveGroupsAndIsTheLengthOfSegments) {
  SceneLedger scene = ledger(settings(0, true), true);
  EXPECT_EQ(groups(scene, 15, 3000), (std::vector<std::size_t>{1, 6, 6})) << "30 pictures a second, not 10";
  EXPECT_EQ(scene.end_group().size(), 2U);
  EXPECT_NEAR(scene.patterns()->store().seconds(), 15 / 30.0, 1e-9);
}

TEST(SceneLedger, WithoutAKeyIntervalAScenesSegmentEndsItAndOnePatternNeverDoes) {
  EXPECT_TRUE(ledger({}, true).scene_ends());
  EXPECT_FALSE(ledger({}, false).scene_ends());
}

TEST(SceneLedger, ASceneIsAsLongAsTheKeyInterval) {
  for (const bool live : {false, true}) {
    SceneLedger scene = ledger(settings(2.5, live), live);
    EXPECT_EQ(groups(scene, 24).back(), live ? 2U : 10U);
    EXPECT_FALSE(scene.scene_ends());
    EXPECT_EQ(groups(scene, 1), std::vector<std::size_t>{live ? 2U : 4U})
        << "a shorter group, or a whole one";
    EXPECT_TRUE(scene.scene_ends());
  }
}

TEST(SceneLedger, AKeyIntervalIsTime) {
  SceneLedger scene = ledger(settings(2.5, true), true);  // 25 pictures by the frame rate
  groups(scene, 74, 3000);
  EXPECT_FALSE(scene.scene_ends());
  groups(scene, 1, 3000);
  EXPECT_TRUE(scene.scene_ends());
}

TEST(SceneLedger, ARequestHoldsUntilTheSceneHasEnded) {
  SceneLedger scene = ledger(settings(0, true), false);
  groups(scene, 3);
  EXPECT_FALSE(scene.scene_ends());
  scene.request_scene();
  EXPECT_TRUE(scene.scene_ends());
  scene.end_scene();
  scene.request_scene();
  EXPECT_FALSE(scene.scene_ends()) << "it has ended already";
}

TEST(SceneLedger, AnotherSceneSaysWhereInTheStreamItBegins) {
  SceneLedger scene = ledger({}, false);
  ASSERT_TRUE(scene.add(noise_picture(160, 128, 1), 0));
  ASSERT_TRUE(scene.add(noise_picture(160, 128, 1), 123));
  scene.end_scene();
  EXPECT_TRUE(scene.scene_ended());
  fbs::Setup next = setup();
  scene.begin_again(next);
  EXPECT_FALSE(scene.scene_ended());
  EXPECT_EQ(scene.pictures(), 0U);
  EXPECT_EQ(next.before.pictures, 2U);
  EXPECT_EQ(next.before.time, 90000U / kFps + 123);
}

}  // namespace
}  // namespace fbs
