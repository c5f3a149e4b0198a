#include "encoder.h"

#include <fbs/encoder.h>
#include <nanobind/stl/optional.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "guarded.h"
#include "owned_array.h"
#include "plane_view.h"

namespace nb = nanobind;

namespace fbs_python {
namespace {

using Encoder = Guarded<fbs_encoder, fbs_encoder_close, fbs_encoder_error>;

/// Reads setting `name`; Python has filled in the defaults.
template <class T>
void take(const nb::dict& settings, const char* name, T& out) {
  out = nb::cast<T>(settings[name]);
}

void open(Encoder* self, const nb::dict& settings) {
  fbs_encoder_settings s;
  fbs_encoder_default_settings(&s, sizeof s);
  take(settings, "width", s.format.width);
  take(settings, "height", s.format.height);
  take(settings, "rate_num", s.format.frame_rate_num);
  take(settings, "rate_den", s.format.frame_rate_den);
  take(settings, "aspect_num", s.format.pixel_aspect_num);
  take(settings, "aspect_den", s.format.pixel_aspect_den);
  s.format.matrix = static_cast<fbs_matrix>(nb::cast<int>(settings["matrix"]));
  take(settings, "full_range", s.format.full_range);
  take(settings, "quality", s.quality);
  take(settings, "bitrate", s.bitrate);
  take(settings, "seconds", s.seconds);
  take(settings, "effort", s.effort);
  take(settings, "tune", s.tune);
  take(settings, "patterns", s.patterns);
  take(settings, "face", s.face);
  take(settings, "allow_no_face", s.allow_no_face);
  take(settings, "key_interval", s.key_interval);
  take(settings, "live", s.live);
  take(settings, "live_delay", s.live_delay);
  take(settings, "live_buffer", s.live_buffer);
  take(settings, "threads", s.threads);
  take(settings, "resilience", s.resilience);
  take(settings, "join", s.join);
  take(settings, "start", s.start);
  char why[FBS_ERROR_SIZE] = "";
  s.open_error = why;
  fbs_encoder* encoder = nullptr;
  const fbs_status status = fbs_encoder_open(&encoder, &s);
  if (status < 0) throw StatusError(status, why);
  new (self) Encoder(encoder);
}

void push(Encoder& self, const ConstPlaneArray& y, const ConstPlaneArray& u, const ConstPlaneArray& v,
          std::uint32_t duration, std::optional<std::int64_t> time) {
  const fbs_const_picture picture = view_of(y, u, v);
  const fbs_stamp stamp = {sizeof stamp, time.value_or(FBS_NO_TIME), 0, duration};
  self.call([&](fbs_encoder* e) { Encoder::check(e, fbs_encoder_push_stamped(e, &picture, &stamp)); });
}

/// @return whether a packet is ready
bool wait(Encoder& self, std::uint32_t milliseconds) {
  return self.call(
      [&](fbs_encoder* e) { return Encoder::check(e, fbs_encoder_wait(e, milliseconds)) == FBS_OK; });
}

/// Bytes, whether decoding can begin with them, number and time of the first picture that needs them, and the
/// time it was pushed with, if there is one.
nb::object pull(Encoder& self) {
  std::string bytes;
  fbs_packet packet{};
  fbs_stamp stamp = {sizeof stamp, FBS_NO_TIME, 0, 0};
  const fbs_status status = self.call([&](fbs_encoder* e) {
    const fbs_status pulled = Encoder::check(e, fbs_encoder_pull(e, &packet));
    if (pulled != FBS_OK) return pulled;
    bytes.assign(reinterpret_cast<const char*>(packet.data), packet.size);
    if (packet.type != FBS_PACKET_END) Encoder::check(e, fbs_encoder_get_stamp(e, &stamp));
    return pulled;
  });
  if (status != FBS_OK) return nb::none();
  return nb::make_tuple(nb::bytes(bytes.data(), bytes.size()), packet.key != 0, packet.number, packet.time,
                        stamp.time == FBS_NO_TIME ? nb::none() : nb::object(nb::int_(stamp.time)));
}

nb::tuple report(Encoder& self) {
  const auto r = self.call([](fbs_encoder* e) {
    fbs_encoder_report out{};
    Encoder::check(e, fbs_encoder_get_report(e, &out));
    return out;
  });
  return nb::make_tuple(r.pictures, r.without_face, r.cuts, r.scenes);
}

nb::object landmarks(Encoder& self) {
  std::array<fbs_landmark, FBS_LANDMARKS> points{};
  const fbs_status status = self.call([&](fbs_encoder* e) {
    const fbs_status asked = fbs_encoder_get_landmarks(e, points.data());
    return asked == FBS_ERROR_NO_FACE ? asked : Encoder::check(e, asked);
  });
  if (status != FBS_OK) return nb::none();
  std::vector<float> values;
  for (const fbs_landmark& point : points) values.insert(values.end(), {point.x, point.y, point.confidence});
  return owned_array(std::move(values), {FBS_LANDMARKS, 3});
}

}  // namespace

void bind_encoder(nb::module_& module) {
  nb::class_<Encoder>(module, "Encoder")
      .def("__init__", open, nb::arg("settings"))
      .def("close", &Encoder::close)
      .def("push", push, nb::arg("y"), nb::arg("u"), nb::arg("v"), nb::arg("duration"),
           nb::arg("time").none())
      .def("wait", wait, nb::arg("milliseconds"))
      .def("request_scene",
           [](Encoder& self) {
             self.call([](fbs_encoder* e) { Encoder::check(e, fbs_encoder_request_scene(e)); });
           })
      .def("lose_patterns",
           [](Encoder& self) {
             self.call([](fbs_encoder* e) { Encoder::check(e, fbs_encoder_lose_patterns(e)); });
           })
      .def(
          "set_bitrate",
          [](Encoder& self, double kbps) {
            self.call([&](fbs_encoder* e) { Encoder::check(e, fbs_encoder_set_bitrate(e, kbps)); });
          },
          nb::arg("kbps"))
      .def("finish",
           [](Encoder& self) { self.call([](fbs_encoder* e) { Encoder::check(e, fbs_encoder_finish(e)); }); })
      .def("pull", pull)
      .def("report", report)
      .def("landmarks", landmarks);
}

}  // namespace fbs_python
