#include <gst/video/video.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/gstreamer/stream.h"

namespace fbs::gstreamer {
namespace {

int keys(const std::vector<Buffer>& groups) {
  return static_cast<int>(std::ranges::count_if(groups, is_key));
}

TEST(FbsEnc, BuffersAreTheStream) {
  const std::vector<Buffer> groups = encoded(kPictures);
  const Decoded pictures = decoded(joined(groups));
  EXPECT_EQ(pictures.errors, 0);
  EXPECT_EQ(pictures.pictures.size(), kPictures);
  EXPECT_TRUE(is_key(groups.front()));
  EXPECT_EQ(keys(groups), 1);
}

TEST(FbsEnc, BuffersHaveTheTimeOfTheirFirstPictureAndLastUntilTheNext) {
  const std::vector<Buffer> groups = encoded(kPictures);
  for (std::size_t k = 0; k + 1 < groups.size(); ++k) {
    const GstBuffer* const group = groups[k].get();
    EXPECT_GT(GST_BUFFER_DURATION(group), 0U);
    EXPECT_EQ(GST_BUFFER_PTS(group) + GST_BUFFER_DURATION(group), GST_BUFFER_PTS(groups[k + 1].get())) << k;
  }
  EXPECT_EQ(GST_BUFFER_PTS(groups.front().get()), 0U);
  EXPECT_NEAR(static_cast<double>(GST_BUFFER_PTS(groups.back().get())), 2.0 * GST_SECOND,
              2);  // the end packet
}

TEST(FbsEnc, LiveGroupsComeBeforeMorePictures) {
  const Harness harness = encoder_harness("fbsenc threads=1 effort=0 delay=0.2");
  push(harness.get(), talker_buffer(0));
  EXPECT_EQ(pull(harness.get()).size(), 1U);
  for (int k = 1; k <= 6; ++k) push(harness.get(), talker_buffer(k));
  EXPECT_EQ(pull(harness.get()).size(), 1U);
}

TEST(FbsEnc, WithLookAheadItIsAWholeStreamToo) {
  const Harness harness = encoder_harness("fbsenc live=false effort=0");
  for (int k = 0; k < kPictures; ++k) push(harness.get(), talker_buffer(k));
  const Decoded pictures = decoded(joined(finish(harness.get())));
  EXPECT_EQ(pictures.errors, 0);
  EXPECT_EQ(pictures.pictures.size(), kPictures);
}

TEST(FbsEnc, TheTuneChangesTheStream) {
  const auto tuned = [](const std::string& to) {
    const Harness harness = encoder_harness("fbsenc live=false effort=0 tune=" + to);
    for (int k = 0; k < kPictures; ++k) push(harness.get(), talker_buffer(k));
    return joined(finish(harness.get()));
  };
  EXPECT_NE(tuned("eye"), tuned("psnr"));
}

TEST(FbsEnc, ReportsTheDelayOfAGroupAndOnePicture) {
  const Harness harness = encoder_harness("fbsenc threads=1 delay=0.3");
  push(harness.get(), talker_buffer(0));
  const GstClockTime latency = gst_harness_query_latency(harness.get());
  EXPECT_NEAR(static_cast<double>(latency), 0.3 * GST_SECOND + kFrame, 1e3);
}

TEST(FbsEnc, AKeyUnitOnRequestIsASceneOfTheSameStreamWithinTheDelay) {
  for (const char* settings : {"", "patterns=1", "threads=2"}) {
    const std::vector<Buffer> groups = encoded(kPictures, {20, 45}, 1, settings);
    const std::vector<std::size_t> scenes = scenes_of(groups);
    ASSERT_EQ(scenes.size(), 3U) << settings;
    for (const auto& [scene, asked] : {std::pair(scenes[1], 20U), std::pair(scenes[2], 45U)}) {
      EXPECT_GE(scene, asked) << settings;
      EXPECT_LE(scene, asked + kGroup) << settings;
    }
    const Decoded pictures = decoded(joined(groups));
    EXPECT_EQ(pictures.errors, 0);
    ASSERT_EQ(pictures.pictures.size(), kPictures);
    for (std::size_t k = 0; k < kPictures; ++k) {
      const fbs_picture_info& info = pictures.pictures[k].info;
      EXPECT_EQ(info.number, k);
      EXPECT_EQ(info.time, k * FBS_TICKS_PER_SECOND / kRate);
      EXPECT_EQ(info.new_scene, std::ranges::count(scenes, k)) << k;
      EXPECT_EQ(info.held, 0);
    }
  }
}

TEST(FbsEnc, ARequestBeforeTheFirstPictureOrWithoutLiveAddsNoScene) {
  EXPECT_EQ(keys(encoded(20, {0})), 1);
  const std::vector<Buffer> groups = encoded(20, {10}, 1, "live=false");
  EXPECT_EQ(keys(groups), 1);
  EXPECT_EQ(decoded(joined(groups)).errors, 0);
}

TEST(FbsEnc, AnswersARequestDownstreamBeforeTheSceneWithItsTimes) {
  const Harness harness = encoder_harness("fbsenc threads=1 effort=0");
  for (int k = 0; k < 10; ++k) push(harness.get(), talker_buffer(k));
  gst_harness_push_upstream_event(harness.get(),
                                  gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 7));
  for (int k = 10; k < 20; ++k) push(harness.get(), talker_buffer(k));
  int answers = 0;
  GstClockTime stream_time = 0, running_time = 0;
  guint count = 0;
  while (GstEvent* const event = gst_harness_try_pull_event(harness.get())) {
    if (gst_video_event_is_force_key_unit(event)) {
      ++answers;
      gst_video_event_parse_downstream_force_key_unit(event, nullptr, &stream_time, &running_time, nullptr,
                                                      &count);
    }
    gst_event_unref(event);
  }
  const std::vector<Buffer> groups = finish(harness.get());
  const auto scene = std::ranges::find_if(groups.begin() + 1, groups.end(), is_key);
  ASSERT_NE(scene, groups.end());
  EXPECT_EQ(answers, 1);
  EXPECT_EQ(count, 7U);
  EXPECT_EQ(stream_time, GST_BUFFER_PTS(scene->get()));
  EXPECT_EQ(running_time, GST_BUFFER_PTS(scene->get()));
}

TEST(FbsEnc, TheBitrateMayChangeWhileItPlays) {
  const auto bytes_at = [](guint bitrate) {
    const Harness harness = encoder_harness("fbsenc threads=1 effort=0 live=true bitrate=8000 start=0.5");
    for (int k = 0; k < 8; ++k) push(harness.get(), talker_buffer(k));
    pull(harness.get());
    GstElement* const element = gst_harness_find_element(harness.get(), "fbsenc");
    g_object_set(element, "bitrate", bitrate, nullptr);
    gst_object_unref(element);
    for (int k = 8; k < kPictures; ++k) push(harness.get(), talker_buffer(k));
    return joined(finish(harness.get())).size();
  };
  EXPECT_LT(bytes_at(500), bytes_at(60000));
}

TEST(FbsEnc, AFlushBeginsANewStream) {
  const Harness harness = encoder_harness("fbsenc threads=1 effort=0");
  for (int k = 0; k < 10; ++k) push(harness.get(), talker_buffer(k));
  pull(harness.get());
  gst_harness_push_event(harness.get(), gst_event_new_flush_start());
  gst_harness_push_event(harness.get(), gst_event_new_flush_stop(TRUE));
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  gst_harness_push_event(harness.get(), gst_event_new_segment(&segment));
  for (int k = 20; k < 35; ++k) push(harness.get(), talker_buffer(k));
  const std::vector<Buffer> groups = finish(harness.get());
  const Decoded pictures = decoded(joined(groups));
  EXPECT_EQ(pictures.errors, 0);
  EXPECT_EQ(pictures.pictures.size(), 15U);
  EXPECT_EQ(GST_BUFFER_PTS(groups.front().get()), 20 * GST_SECOND / kRate);
}

TEST(FbsEnc, APauseProlongsAPicture) {
  const Harness harness = encoder_harness("fbsenc threads=1 effort=0");
  for (const int k : {0, 1, 2, 12, 13}) push(harness.get(), talker_buffer(k));
  const Decoded pictures = decoded(joined(finish(harness.get())));
  ASSERT_EQ(pictures.pictures.size(), 5U);
  const fbs_picture_info& last = pictures.pictures.back().info;
  EXPECT_EQ(last.time + last.duration, 14U * FBS_TICKS_PER_SECOND / kRate);
}

TEST(FbsEnc, DropsWhatIsLateAndSaysSo) {
  const Harness harness = encoder_harness("fbsenc threads=1 effort=0 qos=true");
  Messages messages(harness.get());
  for (int k = 0; k < 3; ++k) push(harness.get(), talker_buffer(k));
  gst_harness_push_upstream_event(harness.get(),
                                  gst_event_new_qos(GST_QOS_TYPE_UNDERFLOW, 0.1, 0, 10 * kFrame));
  for (int k = 3; k < 20; ++k) push(harness.get(), talker_buffer(k));
  const std::size_t shown = decoded(joined(finish(harness.get()))).pictures.size();
  EXPECT_GT(shown, 3U);
  EXPECT_LT(shown, 20U);
  EXPECT_EQ(messages.count(GST_MESSAGE_QOS), 20 - static_cast<int>(shown));
}

TEST(FbsEnc, NoFaceIsAnErrorOnlyWhereItIsNotAllowed) {
  for (const bool allowed : {true, false}) {
    const Harness harness = encoder_harness(std::string("fbsenc threads=1 effort=0 allow-no-face=") +
                                            (allowed ? "true" : "false"));
    Messages messages(harness.get());
    for (int k = 0; k < 5; ++k) {
      Buffer grey = talker_buffer(k);
      gst_buffer_memset(grey.get(), 0, 128, gst_buffer_get_size(grey.get()));
      push(harness.get(), std::move(grey));
    }
    finish(harness.get());
    EXPECT_EQ(messages.count(GST_MESSAGE_ERROR), allowed ? 0 : 1);
  }
}

}  // namespace
}  // namespace fbs::gstreamer
