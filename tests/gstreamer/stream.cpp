#include "tests/gstreamer/stream.h"

#include <gst/video/video.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "tests/talker/talker_render.h"

namespace fbs::gstreamer {
namespace {

constexpr const char* kGroupCaps = "video/x-fbs, stream-format=byte-stream, alignment=group";

const talker::Talker& the_talker() {
  static const talker::Talker made([] {
    talker::Settings settings;
    settings.width = settings.height = kSide;
    settings.frame_count = kPictures;
    return settings;
  }());
  return made;
}

const Bytes& samples_of(int number) {
  static std::vector<Bytes> drawn(kPictures);
  Bytes& out = drawn[static_cast<std::size_t>(number)];
  if (out.empty()) {
    const Picture picture = the_talker().picture(number);
    for (const Plane* plane : {&picture.y, &picture.u, &picture.v})
      out.insert(out.end(), plane->samples.begin(), plane->samples.end());
  }
  return out;
}

Harness harness_of(const std::string& line, const std::string& caps) {
  Harness harness(gst_harness_new_parse(line.c_str()));
  gst_harness_set_src_caps_str(harness.get(), caps.c_str());
  return harness;
}

Buffer wrapped(const Bytes& bytes) {
  return Buffer(gst_buffer_new_memdup(bytes.data(), bytes.size()));
}

}  // namespace

Buffer talker_buffer(int number) {
  Buffer buffer = wrapped(samples_of(number));
  GST_BUFFER_PTS(buffer.get()) = gst_util_uint64_scale(static_cast<guint64>(number), GST_SECOND, kRate);
  GST_BUFFER_DURATION(buffer.get()) = kFrame;
  return buffer;
}

std::string picture_caps(int width, int height) {
  return "video/x-raw, format=I420, width=" + std::to_string(width) + ", height=" + std::to_string(height) +
         ", framerate=" + std::to_string(kRate) + "/1";
}

Harness encoder_harness(const std::string& line) {
  return harness_of(line, picture_caps(kSide, kSide));
}

Harness group_harness(const std::string& line) {
  return harness_of(line, kGroupCaps);
}

void push(GstHarness* harness, Buffer buffer) {
  ASSERT_EQ(gst_harness_push(harness, buffer.release()), GST_FLOW_OK);
}

std::vector<Buffer> pull(GstHarness* harness) {
  std::vector<Buffer> out;
  while (GstBuffer* const buffer = gst_harness_try_pull(harness)) out.emplace_back(buffer);
  return out;
}

std::vector<Buffer> finish(GstHarness* harness) {
  gst_harness_push_event(harness, gst_event_new_eos());
  return pull(harness);
}

std::vector<Buffer> encoded(int pictures, const std::vector<int>& scenes, int slower,
                            const std::string& settings) {
  const Harness harness = encoder_harness("fbsenc threads=1 effort=0 " + settings);
  for (int k = 0; k < pictures; ++k) {
    if (std::ranges::find(scenes, k) != scenes.end())
      gst_harness_push_upstream_event(
          harness.get(), gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 0));
    Buffer picture = talker_buffer(k);
    GST_BUFFER_PTS(picture.get()) *= static_cast<guint64>(slower);
    GST_BUFFER_DURATION(picture.get()) *= static_cast<guint64>(slower);
    push(harness.get(), std::move(picture));
  }
  return finish(harness.get());
}

std::vector<std::size_t> scenes_of(const std::vector<Buffer>& groups, int slower) {
  std::vector<std::size_t> out;
  for (const Buffer& group : groups)
    if (is_key(group))
      out.push_back(gst_util_uint64_scale_round(GST_BUFFER_PTS(group.get()), kRate,
                                                static_cast<guint64>(slower) * GST_SECOND));
  return out;
}

Bytes bytes_of(GstBuffer* buffer) {
  Bytes out(gst_buffer_get_size(buffer));
  gst_buffer_extract(buffer, 0, out.data(), out.size());
  return out;
}

Bytes joined(const std::vector<Buffer>& buffers) {
  Bytes out;
  for (const Buffer& buffer : buffers) std::ranges::copy(bytes_of(buffer.get()), std::back_inserter(out));
  return out;
}

Buffer copy_of(const Buffer& buffer) {
  return Buffer(gst_buffer_copy_deep(buffer.get()));
}

Decoded decoded(const Bytes& stream) {
  Decoded out;
  fbs_decoder* decoder = nullptr;
  EXPECT_EQ(fbs_decoder_open(&decoder, nullptr), FBS_OK);
  fbs_decoder_feed(decoder, stream.data(), stream.size());
  fbs_decoder_finish(decoder);
  fbs_picture_info info;
  for (fbs_status status; (status = fbs_decoder_next(decoder, &info)) != FBS_END;) {
    if (status != FBS_OK) {
      ++out.errors;
      continue;
    }
    fbs_const_picture picture;
    EXPECT_EQ(fbs_decoder_get_picture(decoder, &picture), FBS_OK);
    Bytes samples;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t shift = k > 0 ? 1 : 0;
      for (std::uint32_t y = 0; y < picture.height >> shift; ++y) {
        const std::uint8_t* const row = picture.data[k] + static_cast<ptrdiff_t>(y) * picture.stride[k];
        samples.insert(samples.end(), row, row + (picture.width >> shift));
      }
    }
    out.pictures.push_back({info, samples});
  }
  fbs_decoder_close(&decoder);
  return out;
}

Messages::Messages(GstHarness* harness) : bus_(gst_bus_new()) {
  gst_element_set_bus(harness->element, bus_);
}

Messages::~Messages() {
  gst_bus_set_flushing(bus_, TRUE);
  gst_object_unref(bus_);
}

int Messages::count(GstMessageType type) {
  int found = 0;
  while (GstMessage* const message = gst_bus_pop_filtered(bus_, type)) {
    ++found;
    gst_message_unref(message);
  }
  return found;
}

int scene_requests(GstHarness* harness) {
  int found = 0;
  while (GstEvent* const event = gst_harness_try_pull_upstream_event(harness)) {
    found += gst_video_event_is_force_key_unit(event) ? 1 : 0;
    gst_event_unref(event);
  }
  return found;
}

}  // namespace fbs::gstreamer
