#include "encoder/segment/segment_store.h"

#include <gtest/gtest.h>

#include "bitstream/packet.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// Two groups of two pictures, the last of which begins another shot.
SegmentStore store() {
  SegmentStore out(toy_setup().format, coded_pose(toy_state()), 1);
  for (unsigned t = 0; t < 4; ++t) {
    if (t == 3) out.cut();
    EXPECT_TRUE(out.add(noise_picture(160, 128, t)));
  }
  for (int g = 0; g < 2; ++g) out.add(std::vector(2, toy_state(90)), {1, 2, 3});
  return out;
}

TEST(SegmentStore, PicturesAreNumberedThroughTheScene) {
  SegmentStore s = store();
  EXPECT_TRUE(s.is_first());
  EXPECT_EQ(s.segment().states[3].picture, 3);
  s.end_segment();
  EXPECT_FALSE(s.is_first());
  EXPECT_EQ(s.segment().pictures.count(), 0U);
  s.add(std::vector(1, toy_state()), {});
  EXPECT_EQ(s.segment().states[0].picture, 4);
  s.end_segment();
  s.begin_scene(coded_pose(toy_state()));
  EXPECT_TRUE(s.is_first());
}

TEST(SegmentStore, TheSegmentLastsAsLongAsItsPictures) {
  SegmentStore s = store();
  const VideoFormat format = toy_setup().format;
  const double fps = static_cast<double>(format.frame_rate.num) / format.frame_rate.den;
  const std::uint32_t nominal = nominal_duration(format.frame_rate);
  s.end_group(std::vector<std::uint32_t>{0, nominal});
  EXPECT_EQ(s.seconds(), 4 / fps);
  s.end_group(std::vector<std::uint32_t>{0, 45'000});
  EXPECT_NEAR(s.seconds(), 3 / fps + 0.5, 1e-9);
  s.end_segment();
  EXPECT_EQ(s.seconds(), 0);
}

TEST(SegmentStore, AShotBeginsWithACut) {
  const SegmentStore s = store();
  ASSERT_EQ(s.segment().shots.size(), 2U);
  EXPECT_EQ(s.segment().shots[0].pictures, 3U);
  EXPECT_TRUE(s.segment().is_cut(3));
}

TEST(SegmentStore, TheScenesFirstPatternHasAStateOfItsOwn) {
  const Scene scene = toy_scene(noise_picture(160, 128, 1));
  SegmentStore s = store();
  EXPECT_EQ(s.seen_state(scene, 0).pose, toy_state().pose);
  EXPECT_EQ(s.seen_state(scene, 1).pose, toy_state(90).pose);
  s.end_segment();
  s.add(std::vector(1, toy_state(90)), {});
  EXPECT_EQ(s.seen_state(scene, 0).pose, toy_state(90).pose);
}

TEST(SegmentStore, ATrialOfTheCodersLeavesThemUnchanged) {
  SegmentStore s = store();
  SegmentStore::Coders trial = s.coders();
  const auto tried = trial.blends.encode(s.blend_group(trial.blends, 0, 2));
  const auto coded = s.coders().blends.encode(s.blend_group(s.coders().blends, 0, 2));
  ASSERT_TRUE(tried && coded);
  EXPECT_EQ(*tried, *coded);
}

TEST(SegmentStore, ContrastStaysWhereTheSceneAsksForNoOther) {
  const Scene scene = toy_scene(noise_picture(160, 128, 1));
  const Picture source = noise_picture(160, 128, 2);
  Picture picture = source;
  store().reduce_contrast(scene, 1, picture);
  EXPECT_EQ(picture.y.samples, source.y.samples);
}

TEST(TypedPayloads, TakeTheirPacketsBytes) {
  const std::vector<TypedPayload> packets = {{PacketType::kMotion, {1, 2}}, {PacketType::kBlend, {}}};
  EXPECT_EQ(bytes_of(packets), packet_size(2) + packet_size(0));
}

}  // namespace
}  // namespace fbs
