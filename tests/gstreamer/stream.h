// A talker, its streams, and the library's output for them, with which the elements are compared.
#pragma once

#include <fbs/fbs.h>
#include <gst/check/gstharness.h>
#include <gst/gst.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace fbs::gstreamer {

inline constexpr int kSide = 112, kRate = 30, kPictures = 60;
/// Pictures in a live group, for a delay of 0.2 s.
inline constexpr int kGroup = 6;
inline constexpr GstClockTime kFrame = GST_SECOND / kRate;

struct CloseHarness {
  void operator()(GstHarness* harness) const { gst_harness_teardown(harness); }
};
using Harness = std::unique_ptr<GstHarness, CloseHarness>;

struct UnrefBuffer {
  void operator()(GstBuffer* buffer) const { gst_buffer_unref(buffer); }
};
using Buffer = std::unique_ptr<GstBuffer, UnrefBuffer>;

using Bytes = std::vector<std::uint8_t>;

/// A picture of the talker, I420, with its time.
Buffer talker_buffer(int number);

/// `line` as for gst-launch, with one element or a bin. Takes pictures of the talker.
Harness encoder_harness(const std::string& line);
/// The caps of its input.
std::string picture_caps(int width, int height);
/// The same for groups.
Harness group_harness(const std::string& line);

void push(GstHarness* harness, Buffer buffer);
/// All buffers that are ready.
std::vector<Buffer> pull(GstHarness* harness);
/// The same after the end of the stream.
std::vector<Buffer> finish(GstHarness* harness);

/// Groups of a stream of this many pictures, with a scene requested at each of `scenes`. Made by fbsenc.
/// @param slower    factor on the talker's durations
/// @param settings  of fbsenc; the last ones count
std::vector<Buffer> encoded(int pictures, const std::vector<int>& scenes = {}, int slower = 1,
                            const std::string& settings = {});

Bytes bytes_of(GstBuffer* buffer);
Bytes joined(const std::vector<Buffer>& buffers);
Buffer copy_of(const Buffer& buffer);
inline bool is_key(const Buffer& buffer) {
  return !GST_BUFFER_FLAG_IS_SET(buffer.get(), GST_BUFFER_FLAG_DELTA_UNIT);
}

/// Pictures with which scenes begin.
std::vector<std::size_t> scenes_of(const std::vector<Buffer>& groups, int slower = 1);

struct DecodedPicture {
  fbs_picture_info info;
  Bytes samples;  ///< of all planes
};
struct Decoded {
  std::vector<DecodedPicture> pictures;
  int errors = 0;
};
/// Decodes with the library.
Decoded decoded(const Bytes& stream);

/// How many messages of a type the elements have posted.
class Messages {
 public:
  explicit Messages(GstHarness* harness);
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;
  int count(GstMessageType type);

 private:
  GstBus* bus_;
};

/// How many times a scene was asked for upstream.
int scene_requests(GstHarness* harness);

}  // namespace fbs::gstreamer
