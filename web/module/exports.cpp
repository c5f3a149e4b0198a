// What src/fbs_module.js calls. Times are seconds; a decoder is one of the exports' first argument. There are
// no exceptions in the module: what has no memory traps, and the module is done with.
#include <emscripten/emscripten.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "bitstream/sound_time.h"
#include "library/boundary.h"
#include "library/face_data.h"
#include "web/module/web_decoder.h"

namespace {

using namespace fbs;
using web::WebDecoder;

double seconds_of(std::uint64_t ticks) {
  return static_cast<double>(ticks) / kTicksPerSecond;
}

std::uint64_t ticks_of(double seconds) {
  return static_cast<std::uint64_t>(std::clamp(seconds, 0.0, seconds_of(kMaxStreamTime)) * kTicksPerSecond +
                                    0.5);
}

/// The layouts of the arrays are those of src/fbs_module.js.
struct Instance {
  WebDecoder decoder;
  LastError error;
  std::array<double, 5> picture{};  ///< number, time, duration, held, new scene
  std::array<std::int32_t, 8>
      format{};  ///< width, height, rate, aspect (each as a fraction), matrix, full range
  std::array<const std::uint8_t*, 3> planes{};
  std::vector<float> face;  ///< 6 of the pose, then x, y, confidence of each landmark, then blendshapes
  std::vector<std::int16_t> samples;

  int fail(const Error& e) { return error.set(status_of(e.code), e.text.c_str(), e.byte_offset); }
};

}  // namespace

#define WEB_EXPORT extern "C" EMSCRIPTEN_KEEPALIVE

WEB_EXPORT Instance* web_open() {
  return new Instance;
}

WEB_EXPORT void web_close(Instance* d) {
  delete d;
}

WEB_EXPORT std::uint8_t* web_room(Instance* d, std::size_t size) {
  return d->decoder.room(size).data();
}

WEB_EXPORT void web_feed(Instance* d) {
  d->decoder.feed();
}

WEB_EXPORT void web_finish(Instance* d) {
  d->decoder.finish();
}

WEB_EXPORT int web_next(Instance* d) {
  const auto status = d->decoder.next();
  if (!status) return d->fail(status.error());
  if (*status != DecodeStatus::kPicture) return *status == DecodeStatus::kEnd ? FBS_END : FBS_NEED_DATA;
  const StreamDecoder& stream = d->decoder.stream();
  d->picture = {static_cast<double>(stream.position().pictures), seconds_of(stream.position().time),
                seconds_of(stream.duration()), stream.held() ? 1.0 : 0.0,
                !stream.held() && stream.state().picture == 0 ? 1.0 : 0.0};
  return FBS_OK;
}

WEB_EXPORT int web_seek(Instance* d, double time) {
  return d->decoder.seek(ticks_of(time)) ? FBS_OK : FBS_NEED_DATA;
}

WEB_EXPORT const char* web_error(const Instance* d) {
  return d->error.text();
}

WEB_EXPORT double web_error_offset(const Instance* d) {
  return static_cast<double>(d->error.offset());
}

WEB_EXPORT const double* web_picture(const Instance* d) {
  return d->picture.data();
}

WEB_EXPORT const std::int32_t* web_format(Instance* d) {
  const VideoFormat& format = d->decoder.stream().format();
  const auto number = [](auto value) { return static_cast<std::int32_t>(value); };
  d->format = {format.width,
               format.height,
               number(format.frame_rate.num),
               number(format.frame_rate.den),
               number(format.pixel_aspect.num),
               number(format.pixel_aspect.den),
               number(format.matrix),
               number(format.range)};
  return d->format.data();
}

WEB_EXPORT const std::uint8_t* const* web_draw(Instance* d) {
  const auto drawn = d->decoder.draw();
  if (!drawn) {
    d->fail(drawn.error());
    return nullptr;
  }
  d->planes = {(*drawn)->y.samples.data(), (*drawn)->u.samples.data(), (*drawn)->v.samples.data()};
  return d->planes.data();
}

WEB_EXPORT const float* web_face(Instance* d) {
  const WebDecoder::Face* const face = d->decoder.face();
  if (face == nullptr) return nullptr;
  const fbs_face_state& s = face->state;
  d->face = {s.pitch, s.yaw, s.roll, s.x, s.y, s.eye_distance};
  for (const fbs_landmark& point : face->landmarks)
    d->face.insert(d->face.end(), {point.x, point.y, point.confidence});
  for (const double weight : face->blendshapes) d->face.push_back(static_cast<float>(weight));
  return d->face.data();
}

WEB_EXPORT const char* web_blendshapes() {
  static std::string names;
  if (names.empty())
    for (const std::string& name : blendshape_names()) names += names.empty() ? name : ' ' + name;
  return names.c_str();
}

WEB_EXPORT void web_edit(Instance* d, float pitch, float yaw, float roll, float brows, float mouth,
                         float smile, float lids) {
  if (const auto edit = edit_of({pitch, yaw, roll, brows, mouth, smile, lids})) d->decoder.edit(*edit);
}

WEB_EXPORT int web_sound_rate(Instance* d) {
  return d->decoder.sound().sample_rate();
}

WEB_EXPORT int web_sound_channels(Instance* d) {
  return d->decoder.sound().channels();
}

WEB_EXPORT double web_sound_time(Instance* d) {
  return static_cast<double>(d->decoder.sound().time()) / kSoundClock;
}

WEB_EXPORT std::size_t web_sound_take(Instance* d, double end) {
  d->samples = d->decoder.sound().take(sound_time(static_cast<std::int64_t>(ticks_of(end))));
  return d->samples.size();
}

WEB_EXPORT const std::int16_t* web_sound_samples(const Instance* d) {
  return d->samples.data();
}

WEB_EXPORT double web_released(Instance* d) {
  return seconds_of(d->decoder.sound().released());
}

WEB_EXPORT double web_bytes(const Instance* d) {
  return static_cast<double>(d->decoder.bytes());
}

WEB_EXPORT double web_sound_bytes(const Instance* d) {
  return static_cast<double>(d->decoder.sound_bytes());
}
