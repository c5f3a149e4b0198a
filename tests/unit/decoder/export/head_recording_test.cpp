#include "decoder/export/head_recording.h"

#include <gtest/gtest.h>

#include "tests/unit/decoder/export/recorded_talk.h"

namespace fbs {
namespace {

TEST(HeadRecording, KeepsStatesWithTheirTimes) {
  HeadRecording recording;
  record(recording, toy_scene(noise_picture(160, 128, 1)), 4);
  ASSERT_EQ(recording.heads().size(), 1U);
  ASSERT_EQ(recording.heads()[0].states.size(), 4U);
  EXPECT_EQ(recording.heads()[0].states[3].time, 3 * kToyDuration);
  EXPECT_EQ(recording.heads()[0].states[3].state, talking(3));
  EXPECT_EQ(recording.duration(), 4 * kToyDuration);
  EXPECT_EQ(recording.shown().size(), 1U);
  EXPECT_EQ(recording.first_scale(), 32);
}

TEST(HeadRecording, BeginsAtZeroWhereverTheStreamIsJoined) {
  HeadRecording recording;
  const Scene scene = toy_scene(noise_picture(160, 128, 1));
  recording.add(scene, talking(0), 900000, kToyDuration);
  recording.add(scene, talking(1), 900000 + kToyDuration, kToyDuration);
  EXPECT_EQ(recording.heads()[0].states[0].time, 0U);
  EXPECT_EQ(recording.duration(), 2 * kToyDuration);
}

TEST(HeadRecording, KnowsTheSameHeadAgain) {
  HeadRecording recording;
  record(recording, toy_scene(noise_picture(160, 128, 1)), 2);
  record(recording, toy_scene(noise_picture(160, 128, 9)), 2);
  ASSERT_EQ(recording.heads().size(), 1U);
  EXPECT_EQ(recording.heads()[0].pattern, noise_picture(160, 128, 1));
  EXPECT_EQ(recording.heads()[0].states.size(), 4U);
}

TEST(HeadRecording, ShowsOneHeadAtATime) {
  HeadRecording recording;
  record(recording, faceless_scene(), 1);
  record(recording, toy_scene(noise_picture(160, 128, 1)), 2);
  record(recording, wider_scene(), 3);
  EXPECT_EQ(recording.heads().size(), 2U);
  ASSERT_EQ(recording.shown().size(), 3U);
  EXPECT_EQ(recording.shown()[0].head, ShownHead::kNone);
  EXPECT_EQ(recording.shown()[1].begin, kToyDuration);
  EXPECT_EQ(recording.shown()[2].begin, 3 * kToyDuration);
  EXPECT_EQ(recording.shown()[2].head, 1U);
  EXPECT_EQ(recording.times().size(), 6U);
}

TEST(HeadRecording, TakesAPlaneForNoHead) {
  Scene scene = toy_scene(noise_picture(160, 128, 1));
  Geometry flat = toy_geometry();
  for (auto& p : flat.positions) p.z = 0;
  scene.set_geometry(SceneGeometry(scene.setup, flat, even_surround(10, 8, 0), toy_state()));
  HeadRecording recording;
  record(recording, scene, 2);
  EXPECT_TRUE(recording.heads().empty());
}

}  // namespace
}  // namespace fbs
