#include <gst/video/video.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "tests/gstreamer/stream.h"

namespace fbs::gstreamer {
namespace {

TEST(FbsDec, DrawsWhatTheLibraryDraws) {
  const std::vector<Buffer> groups = encoded(kPictures);
  const Decoded expected = decoded(joined(groups));
  const Harness harness = group_harness("fbsdec");
  for (const Buffer& group : groups) push(harness.get(), copy_of(group));
  const std::vector<Buffer> pictures = finish(harness.get());
  ASSERT_EQ(pictures.size(), expected.pictures.size());
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    EXPECT_EQ(bytes_of(pictures[k].get()), expected.pictures[k].samples) << k;
    EXPECT_NEAR(static_cast<double>(GST_BUFFER_PTS(pictures[k].get())),
                static_cast<double>(k) * GST_SECOND / kRate, 1e3);
  }
}

TEST(FbsDec, PicturesAreInStepWithTheirGroup) {
  const GstClockTime later = 77 * GST_SECOND;
  const std::vector<Buffer> groups = encoded(20);
  const Harness harness = group_harness("fbsdec");
  for (const Buffer& group : groups) {
    Buffer copy = copy_of(group);
    GST_BUFFER_PTS(copy.get()) += later;
    push(harness.get(), std::move(copy));
  }
  const std::vector<Buffer> pictures = finish(harness.get());
  ASSERT_EQ(pictures.size(), 20U);
  EXPECT_EQ(GST_BUFFER_PTS(pictures.front().get()), later);
  EXPECT_NEAR(static_cast<double>(GST_BUFFER_PTS(pictures.back().get())),
              static_cast<double>(later) + 19.0 * GST_SECOND / kRate, 1e3);
}

TEST(FbsDec, SaysTheFormat) {
  const std::vector<Buffer> groups = encoded(1);
  const Harness harness = group_harness("fbsdec");
  push(harness.get(), copy_of(groups.front()));
  GstCaps* const caps = gst_pad_get_current_caps(harness->sinkpad);
  GstVideoInfo info;
  ASSERT_TRUE(caps != nullptr && gst_video_info_from_caps(&info, caps));
  gst_caps_unref(caps);
  EXPECT_EQ(GST_VIDEO_INFO_WIDTH(&info), kSide);
  EXPECT_EQ(GST_VIDEO_INFO_FPS_N(&info), kRate);
  EXPECT_EQ(GST_VIDEO_INFO_FORMAT(&info), GST_VIDEO_FORMAT_I420);
}

TEST(FbsDec, GoesOnBehindALostGroupAndAsksForAScene) {
  std::vector<Buffer> groups = encoded(kPictures, {30});
  groups.erase(groups.begin() + 2);
  const Harness harness = group_harness("fbsdec");
  Messages messages(harness.get());
  for (const Buffer& group : groups) push(harness.get(), copy_of(group));
  const std::vector<Buffer> pictures = finish(harness.get());
  EXPECT_EQ(pictures.size(), kPictures);  // what is missing is held
  EXPECT_EQ(messages.count(GST_MESSAGE_WARNING), 1);
  EXPECT_EQ(messages.count(GST_MESSAGE_ERROR), 0);
  EXPECT_EQ(scene_requests(harness.get()), 1);
}

/// Whether a line of the library's has come into GStreamer's log.
struct SeenLine {
  static void look(GstDebugCategory* category, GstDebugLevel level, const gchar*, const gchar*, gint,
                   GObject* element, GstDebugMessage* message, gpointer self) {
    const std::string text = gst_debug_message_get(message);
    if (std::string(gst_debug_category_get_name(category)) == "fbsdec" && level == GST_LEVEL_INFO &&
        GST_IS_ELEMENT(element) && text.find("a scene of 112x112 begins") != std::string::npos)
      static_cast<SeenLine*>(self)->seen = true;
  }
  bool seen = false;
};

TEST(FbsDec, LogsWhatTheLibraryLogs) {
  SeenLine line;
  gst_debug_add_log_function(&SeenLine::look, &line, nullptr);
  gst_debug_set_active(TRUE);
  gst_debug_set_threshold_for_name("fbsdec", GST_LEVEL_INFO);
  const std::vector<Buffer> groups = encoded(1);
  const Harness harness = group_harness("fbsdec");
  push(harness.get(), copy_of(groups.front()));
  gst_debug_unset_threshold_for_name("fbsdec");
  gst_debug_remove_log_function(&SeenLine::look);
  EXPECT_TRUE(line.seen);
}

TEST(FbsDec, JoinsAtAScene) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  const Decoded expected = decoded(joined(groups));
  const std::size_t scene = scenes_of(groups).at(1);
  const Harness harness = group_harness("fbsdec");
  bool joined_in = false;
  for (const Buffer& group : groups) {
    joined_in = joined_in || (is_key(group) && GST_BUFFER_PTS(group.get()) > 0);
    if (joined_in) push(harness.get(), copy_of(group));
  }
  const std::vector<Buffer> pictures = finish(harness.get());
  ASSERT_EQ(pictures.size(), kPictures - scene);
  EXPECT_EQ(bytes_of(pictures.front().get()), expected.pictures[scene].samples);
  EXPECT_EQ(GST_BUFFER_PTS(pictures.front().get()),
            GST_BUFFER_PTS(talker_buffer(static_cast<int>(scene)).get()));
}

TEST(FbsDec, DrawsNothingThatIsLate) {
  const std::vector<Buffer> groups = encoded(kPictures);
  const Harness harness = group_harness("fbsdec");
  Messages messages(harness.get());
  push(harness.get(), copy_of(groups[0]));
  gst_harness_push_upstream_event(harness.get(),
                                  gst_event_new_qos(GST_QOS_TYPE_UNDERFLOW, 0.1, 0, GST_SECOND));
  for (std::size_t k = 1; k < groups.size(); ++k) push(harness.get(), copy_of(groups[k]));
  const std::size_t drawn = finish(harness.get()).size();
  EXPECT_GT(drawn, 20U);
  EXPECT_LT(drawn, 40U);
  EXPECT_EQ(messages.count(GST_MESSAGE_QOS), kPictures - static_cast<int>(drawn));
}

TEST(FbsDec, AFlushForgetsTheScene) {
  const std::vector<Buffer> groups = encoded(kPictures);
  const Harness harness = group_harness("fbsdec");
  for (std::size_t k = 0; k < 4; ++k) push(harness.get(), copy_of(groups[k]));
  pull(harness.get());
  gst_harness_push_event(harness.get(), gst_event_new_flush_start());
  gst_harness_push_event(harness.get(), gst_event_new_flush_stop(TRUE));
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  gst_harness_push_event(harness.get(), gst_event_new_segment(&segment));
  for (const Buffer& group : groups) push(harness.get(), copy_of(group));
  EXPECT_EQ(finish(harness.get()).size(), kPictures);
}

/// Grey, of any size.
Buffer grey(int width, int height, int number) {
  const auto w = static_cast<gsize>(width), h = static_cast<gsize>(height);
  Buffer buffer(gst_buffer_new_allocate(nullptr, w * h * 3 / 2, nullptr));
  gst_buffer_memset(buffer.get(), 0, 100, w * h * 3 / 2);
  GST_BUFFER_PTS(buffer.get()) = gst_util_uint64_scale(static_cast<guint64>(number), GST_SECOND, kRate);
  GST_BUFFER_DURATION(buffer.get()) = kFrame;
  return buffer;
}

TEST(FbsDec, AnotherSizeOrRateIsAnotherStream) {
  for (const char* line :
       {"fbsenc threads=1 ! fbsdec", "fbsenc threads=1 ! rtpfbspay ! rtpfbsdepay ! fbsdec"}) {
    const Harness harness = encoder_harness(line);
    Messages messages(harness.get());
    int number = 0;
    for (const auto& [width, height, rate] :
         {std::tuple(80, 64, "30/1"), {96, 80, "30/1"}, {96, 80, "15/1"}}) {
      std::string caps = picture_caps(width, height);
      caps.replace(caps.find("30/1"), 4, rate);
      gst_harness_set_src_caps_str(harness.get(), caps.c_str());
      for (int k = 0; k < 10; ++k) push(harness.get(), grey(width, height, number++));
    }
    const std::vector<Buffer> pictures = finish(harness.get());
    ASSERT_EQ(pictures.size(), 30U) << line;
    EXPECT_EQ(gst_buffer_get_size(pictures[9].get()), 80U * 64 * 3 / 2);
    EXPECT_EQ(gst_buffer_get_size(pictures[10].get()), 96U * 80 * 3 / 2);
    for (std::size_t k = 0; k < 30; ++k)
      EXPECT_NEAR(static_cast<double>(GST_BUFFER_PTS(pictures[k].get())),
                  static_cast<double>(k) * GST_SECOND / kRate, 0.04 * GST_SECOND)
          << k;
    EXPECT_EQ(messages.count(GST_MESSAGE_WARNING), 0) << line;
  }
}

TEST(FbsDec, AStreamWithoutPicturesIsAnError) {
  const Harness harness = group_harness("fbsdec");
  Messages messages(harness.get());
  push(harness.get(), Buffer(gst_buffer_new_memdup("nothing that is fbs", 19)));
  EXPECT_TRUE(finish(harness.get()).empty());
  EXPECT_GE(messages.count(GST_MESSAGE_ERROR), 1);
}

}  // namespace
}  // namespace fbs::gstreamer
