#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <utility>

#include "tests/gstreamer/stream.h"

namespace fbs::gstreamer {
namespace {

Harness parser() {
  Harness harness(gst_harness_new("fbsparse"));
  gst_harness_set_src_caps_str(harness.get(), "video/x-fbs");
  return harness;
}

void push_in_pieces(GstHarness* harness, const Bytes& stream, std::size_t size) {
  for (std::size_t at = 0; at < stream.size(); at += size)
    push(harness, Buffer(gst_buffer_new_memdup(stream.data() + at, std::min(size, stream.size() - at))));
}

/// fbsparse gets bytes, without times.
Harness byte_parser() {
  Harness harness(gst_harness_new("fbsparse"));
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_BYTES);
  gst_harness_set_src_caps_str(harness.get(), "video/x-fbs");
  gst_harness_push_event(harness.get(), gst_event_new_segment(&segment));
  return harness;
}

TEST(FbsParse, FindsTheGroupsOfTheEncoderWhateverThePieces) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  const Bytes stream = joined(groups);
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, std::size_t{1000}, stream.size()}) {
    const Harness harness = byte_parser();
    push_in_pieces(harness.get(), stream, size);
    const std::vector<Buffer> parsed = finish(harness.get());
    ASSERT_EQ(parsed.size(), groups.size()) << size;
    for (std::size_t k = 0; k < groups.size(); ++k) {
      EXPECT_EQ(bytes_of(parsed[k].get()), bytes_of(groups[k].get())) << k;
      EXPECT_EQ(is_key(parsed[k]), is_key(groups[k])) << k;
      EXPECT_NEAR(static_cast<double>(GST_BUFFER_PTS(parsed[k].get())),
                  static_cast<double>(GST_BUFFER_PTS(groups[k].get())), 1e3);
    }
  }
}

TEST(FbsParse, KeepsTheTimesOfUpstream) {
  const std::vector<Buffer> groups = encoded(20);
  const Harness harness = parser();
  for (const Buffer& group : groups) {
    Buffer copy = copy_of(group);
    GST_BUFFER_PTS(copy.get()) += GST_SECOND;
    push(harness.get(), std::move(copy));
  }
  const std::vector<Buffer> parsed = finish(harness.get());
  ASSERT_EQ(parsed.size(), groups.size());
  for (std::size_t k = 0; k < groups.size(); ++k)
    EXPECT_EQ(GST_BUFFER_PTS(parsed[k].get()), GST_BUFFER_PTS(groups[k].get()) + GST_SECOND);
}

TEST(FbsParse, OfASignatureAloneNothingIsLeft) {
  const Harness harness = byte_parser();
  push_in_pieces(harness.get(), {0x89, 'f', 'b', 's'}, 4);
  EXPECT_TRUE(finish(harness.get()).empty());
}

TEST(FbsParse, PassesOverDamageToTheNextScene) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  Bytes stream = joined(groups);
  const std::size_t first = bytes_of(groups[0].get()).size(), second = bytes_of(groups[1].get()).size();
  stream[first + second + 3] ^= 0x30;
  const Harness harness = byte_parser();
  Messages messages(harness.get());
  push_in_pieces(harness.get(), stream, 50);
  const std::vector<Buffer> parsed = finish(harness.get());
  ASSERT_GT(parsed.size(), 3U);
  EXPECT_TRUE(is_key(parsed[2]));
  EXPECT_TRUE(GST_BUFFER_IS_DISCONT(parsed[2].get()));
  EXPECT_EQ(scenes_of(parsed).at(1), scenes_of(groups).at(1));
  EXPECT_EQ(messages.count(GST_MESSAGE_WARNING), 1);
}

TEST(FbsParse, DamageAnywhereCostsItsSceneAlone) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  const Bytes stream = joined(groups);
  const GstClockTime begin = scenes_of(groups).at(1) * GST_SECOND / kRate;
  const auto second_scene = [begin](const std::vector<Buffer>& parsed) {
    Bytes out;
    for (const Buffer& group : parsed)
      if (GST_BUFFER_PTS(group.get()) >= begin)
        std::ranges::copy(bytes_of(group.get()), std::back_inserter(out));
    return out;
  };
  const Bytes expected = second_scene(groups);
  for (std::size_t at = 0; at < stream.size() - expected.size(); at += 13) {
    Bytes damaged = stream;
    damaged[at] ^= static_cast<std::uint8_t>(at % 2 == 0 ? 3U : 0x10U);  // two wrong bits, and one
    const Harness harness = byte_parser();
    push_in_pieces(harness.get(), damaged, 100);
    EXPECT_EQ(second_scene(finish(harness.get())), expected) << at;
  }
}

/// A file that is removed again.
class StreamFile {
 public:
  explicit StreamFile(const Bytes& bytes) : name_(testing::TempDir() + "fbsparse_test.fbs") {
    std::ofstream(name_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  ~StreamFile() { std::remove(name_.c_str()); }
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
};

class Player {
 public:
  Player(const StreamFile& file, const std::string& elements)
      : pipeline_(gst_parse_launch(
            ("filesrc location=" + file.name() + " ! " + elements + " ! fakesink name=sink").c_str(),
            nullptr)) {
    gst_element_set_state(pipeline_, GST_STATE_PAUSED);
    wait();
  }
  ~Player() {
    gst_element_set_state(pipeline_, GST_STATE_NULL);
    gst_object_unref(pipeline_);
  }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Watches the next buffer that the parser sends.
  void watch_parser() {
    first_ = GST_CLOCK_TIME_NONE;
    GstElement* const parser = gst_bin_get_by_name(GST_BIN(pipeline_), "parser");
    GstPad* const pad = gst_element_get_static_pad(parser, "src");
    gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, note_first, this, nullptr);
    gst_object_unref(pad);
    gst_object_unref(parser);
  }
  [[nodiscard]] GstClockTime first_time() const { return first_; }

  void seek(GstClockTime time, GstSeekFlags flags) {
    EXPECT_TRUE(gst_element_seek_simple(pipeline_, GST_FORMAT_TIME,
                                        static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | flags),
                                        static_cast<gint64>(time)));
    wait();
  }

  [[nodiscard]] GstClockTime duration() const {
    gint64 found = 0;
    EXPECT_TRUE(gst_element_query_duration(pipeline_, GST_FORMAT_TIME, &found));
    return static_cast<GstClockTime>(found);
  }

  /// The picture that the sink shows while the pipeline is paused.
  [[nodiscard]] Bytes shown() const {
    GstElement* const sink = gst_bin_get_by_name(GST_BIN(pipeline_), "sink");
    GstSample* sample = nullptr;
    g_object_get(sink, "last-sample", &sample, nullptr);
    gst_object_unref(sink);
    if (sample == nullptr) return {};
    Bytes out = bytes_of(gst_sample_get_buffer(sample));
    gst_sample_unref(sample);
    return out;
  }

 private:
  void wait() {
    EXPECT_EQ(gst_element_get_state(pipeline_, nullptr, nullptr, 60 * GST_SECOND), GST_STATE_CHANGE_SUCCESS);
  }

  static GstPadProbeReturn note_first(GstPad* /*pad*/, GstPadProbeInfo* info, gpointer player) {
    static_cast<Player*>(player)->first_ = GST_BUFFER_PTS(GST_PAD_PROBE_INFO_BUFFER(info));
    return GST_PAD_PROBE_REMOVE;
  }

  GstElement* pipeline_;
  GstClockTime first_ = GST_CLOCK_TIME_NONE;
};

TEST(FbsParse, DecodingBeginsWithTheSceneThatIsSoughtIn) {
  constexpr GstClockTime kSlower = 50;  // scenes of more than half a minute
  const auto time_of = [](GstClockTime number) { return kSlower * number * GST_SECOND / kRate; };
  const std::vector<Buffer> groups = encoded(kPictures, {20, 40}, kSlower, "key-interval=600");
  const std::vector<std::size_t> scenes = scenes_of(groups, kSlower);
  ASSERT_EQ(scenes.size(), 3U);
  const StreamFile file(joined(groups));
  for (const GstSeekFlags flags : {GST_SEEK_FLAG_NONE, GST_SEEK_FLAG_ACCURATE, GST_SEEK_FLAG_KEY_UNIT})
    for (const auto& [number, scene] :
         {std::pair(58UL, scenes[2]), std::pair(38UL, scenes[1]), std::pair(5UL, scenes[0]),
          std::pair(18UL, scenes[0]), std::pair(scenes[2] + 1, scenes[2])}) {
      Player player(file, "fbsparse name=parser ! fbsdec");
      player.watch_parser();
      player.seek(time_of(number) + kFrame, flags);
      EXPECT_NEAR(static_cast<double>(player.first_time()), static_cast<double>(time_of(scene)), 1e5)
          << number << " flags " << flags;
    }
}

TEST(FbsParse, SeeksToThePictureThatIsAskedFor) {
  const Bytes stream = joined(encoded(kPictures, {20, 40}));
  const Decoded expected = decoded(stream);
  const StreamFile file(stream);
  for (const char* elements : {"fbsparse ! fbsdec", "decodebin"}) {
    Player player(file, elements);
    EXPECT_EQ(player.duration(), 2 * GST_SECOND);
    EXPECT_EQ(player.shown(), expected.pictures[0].samples);
    for (const std::size_t number : {50U, 40U, 5U, 39U, 0U, 21U, 59U})
      for (const GstSeekFlags flags : {GST_SEEK_FLAG_NONE, GST_SEEK_FLAG_ACCURATE}) {
        player.seek(number * GST_SECOND / kRate + kFrame / 2, flags);
        EXPECT_EQ(player.shown(), expected.pictures[number].samples) << elements << ' ' << number;
      }
  }
}

}  // namespace
}  // namespace fbs::gstreamer
