#include "encoder/scene/planar_scene.h"

#include <gtest/gtest.h>

#include "encoder/scene/still_scene.h"
#include "tests/unit/encoder/decoded_packets.h"
#include "tests/unit/encoder/moving_pictures.h"

namespace fbs {
namespace {

constexpr int kWidth = 96, kHeight = 80;

template <class Make>
std::vector<Picture> pictures(int count, Make&& make) {
  std::vector<Picture> out;
  for (int t = 0; t < count; ++t) out.push_back(make(t));
  return out;
}

std::vector<Picture> squares(int count) {
  return pictures(count, [](int t) { return circling_squares(kWidth, kHeight, t); });
}

std::vector<Picture> pan(int count, double pixels = 3) {
  return pictures(count, [&](int t) { return seen_wall(kWidth, kHeight, 1, {-pixels * t, pixels * t / 5}); });
}

Shown coded(const std::vector<Picture>& sources, const EncoderSettings& settings = {}, std::size_t cut = 0) {
  auto scene = PlanarScene::begin(format_of(sources[0].width(), sources[0].height()), settings);
  EXPECT_TRUE(scene);
  for (std::size_t t = 0; t < sources.size(); ++t) {
    if (t == cut && cut > 0) (*scene)->cut();
    const auto pushed = (*scene)->push(sources[t], 0);
    EXPECT_TRUE(pushed) << pushed.error().text;
  }
  const auto finished = (*scene)->finish();
  EXPECT_TRUE(finished) << finished.error().text;
  return shown_by((*scene)->take());
}

EncoderSettings of_quality(int quality) {
  EncoderSettings out;
  out.quality = quality;
  return out;
}

TEST(PlanarScene, FewPatternsShowWhatIsStill) {
  const std::vector<Picture> sources(60, scenery(kWidth, kHeight));
  const Shown shown = coded(sources);
  EXPECT_GT(shown.psnr(sources), 34);
  EXPECT_LE(shown.patterns, 3U);
  EXPECT_FALSE(shown.moves.front()) << "a geometry nobody needs";
}

TEST(PlanarScene, PatternsShowWhatMoves) {
  const auto sources = squares(75);
  const Shown shown = coded(sources);
  EXPECT_FALSE(shown.moves.front()) << "the ground is still";
  auto frozen = StillScene::begin(format_of(kWidth, kHeight), {}, sources.front());
  ASSERT_TRUE(frozen);
  for (const Picture& p : sources) ASSERT_TRUE((*frozen)->push(p, 0));
  ASSERT_TRUE((*frozen)->finish());
  EXPECT_GT(shown.psnr(sources), shown_by((*frozen)->take()).psnr(sources) + 3);
}

TEST(PlanarScene, QualityBuysPatterns) {
  const auto sources = squares(75);
  const Shown coarse = coded(sources, of_quality(10)), fine = coded(sources, of_quality(95));
  EXPECT_GT(fine.patterns, 3 * coarse.patterns);
  EXPECT_GT(fine.psnr(sources), coarse.psnr(sources) + 4);
}

TEST(PlanarScene, MovesWithTheCamera) {
  const auto sources = pan(75);
  const Shown shown = coded(sources);
  EXPECT_TRUE(shown.moves.front());
  EXPECT_GT(shown.psnr(sources), 27) << "patterns that only fade reach 20";
}

TEST(PlanarScene, ZoomsAndRolls) {
  const auto sources =
      pictures(50, [](int t) { return seen_wall(kWidth, kHeight, std::polar(1 + 0.008 * t, 0.006 * t), 0); });
  const Shown shown = coded(sources);
  EXPECT_TRUE(shown.moves.front());
  EXPECT_GT(shown.psnr(sources), 27);
}

TEST(PlanarScene, GoesLive) {
  EncoderSettings live;
  live.live.emplace();
  const auto sources = squares(75);
  const Shown shown = coded(sources, live);
  EXPECT_EQ(shown.pictures.size(), sources.size());
  EXPECT_GT(shown.psnr(sources), coded(sources, of_quality(0)).psnr(sources));
}

// That the camera moves is known after some pictures.
TEST(PlanarScene, LiveSceneBeginsAgainWhenTheCameraMoves) {
  EncoderSettings live;
  live.live.emplace();
  std::vector<Picture> sources(30, seen_wall(kWidth, kHeight, 1, 0));
  for (const Picture& p : pan(50)) sources.push_back(p);
  const Shown shown = coded(sources, live);
  EXPECT_FALSE(shown.moves.front());
  EXPECT_TRUE(shown.moves.back());
  EXPECT_EQ(shown.scenes, 2U);
  EXPECT_GT(shown.psnr(sources), 25);
}

TEST(PlanarScene, CarriesAnotherShot) {
  auto sources = squares(40);
  for (const Picture& p : pan(40)) sources.push_back(p);
  const Shown shown = coded(sources, {}, 40);
  EXPECT_EQ(shown.scenes, 1U);
  const std::vector<Picture> last(sources.begin() + 36, sources.begin() + 44);
  Shown around;
  around.pictures.assign(shown.pictures.begin() + 36, shown.pictures.begin() + 44);
  EXPECT_GT(around.psnr(last), 22) << "no fade over the cut";
}

TEST(PlanarScene, HasMorePatternsThanADecoderKeeps) {
  const auto sources = squares(160);
  const Shown shown = coded(sources, of_quality(100));
  EXPECT_GT(shown.patterns, 2U * kMaxPatterns);
  EXPECT_EQ(shown.scenes, 1U);
  EXPECT_GT(shown.psnr(sources), 33);
}

TEST(PlanarScene, ManyPicturesInAGroupHaveNoMorePatternsThanADecoderKeeps) {
  const auto sources = squares(160);
  EncoderSettings settings = of_quality(100);
  settings.group_pictures = 150;
  EXPECT_GT(coded(sources, settings).psnr(sources), 25);
}

TEST(PlanarScene, BeginsAgainAfterAKeyInterval) {
  const auto sources = pan(60);
  EncoderSettings settings;
  settings.key_interval = 1;
  const Shown shown = coded(sources, settings);
  EXPECT_EQ(shown.scenes, 3U);
  EXPECT_GT(shown.psnr(sources), 25);
}

TEST(PlanarScene, BeginsAgainWhereThePlaneEnds) {
  const auto sources = pan(90, 12);  // eleven widths
  const Shown shown = coded(sources);
  EXPECT_GT(shown.scenes, 1U);
  EXPECT_GT(shown.psnr(sources), 18);
}

TEST(PlanarScene, MeetsABitrate) {
  const auto sources = squares(100);
  EncoderSettings settings;
  settings.bitrate = 12;
  settings.seconds = 4;
  const Shown shown = coded(sources, settings);
  EXPECT_NEAR(8e-3 * static_cast<double>(shown.bytes) / 4, 12, 2.5);
}

TEST(PlanarScene, KeepsDurationsAndOnePicture) {
  auto scene = PlanarScene::begin(format_of(kWidth, kHeight), {});
  ASSERT_TRUE(scene);
  ASSERT_TRUE((*scene)->push(scenery(kWidth, kHeight), 9000));
  ASSERT_TRUE((*scene)->finish());
  EXPECT_FALSE((*scene)->analysis().face);
  const Shown shown = shown_by((*scene)->take());
  ASSERT_EQ(shown.pictures.size(), 1U);
  EXPECT_EQ(shown.durations.front(), 9000U);
}

}  // namespace
}  // namespace fbs
