#include "decoder.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "byte_view.h"
#include "guarded.h"
#include "owned_array.h"
#include "plane_view.h"

namespace nb = nanobind;

namespace fbs_python {
namespace {

using Decoder = Guarded<fbs_decoder, fbs_decoder_close, fbs_decoder_error>;
using Landmarks = std::array<fbs_landmark, FBS_LANDMARKS>;

fbs_status check(const fbs_decoder* decoder, fbs_status status) {
  return Decoder::check(decoder, status, fbs_decoder_error_offset(decoder));
}

void open(Decoder* self, int threads, std::uint64_t max_pixels) {
  fbs_decoder_settings settings;
  fbs_decoder_default_settings(&settings, sizeof settings);
  settings.threads = threads;
  settings.max_pixels = max_pixels;
  char why[FBS_ERROR_SIZE] = "";
  settings.open_error = why;
  fbs_decoder* decoder = nullptr;
  const fbs_status status = fbs_decoder_open(&decoder, &settings);
  if (status < 0) throw StatusError(status, why);
  new (self) Decoder(decoder);
}

void feed(Decoder& self, nb::handle piece) {
  const ByteView view(piece);
  self.call([&](fbs_decoder* d) { check(d, fbs_decoder_feed(d, view.bytes().data(), view.bytes().size())); });
}

/// The status, then the members of fbs_picture_info.
nb::tuple next(Decoder& self) {
  fbs_picture_info info{};
  const fbs_status status = self.call([&](fbs_decoder* d) { return check(d, fbs_decoder_next(d, &info)); });
  return nb::make_tuple(static_cast<int>(status), info.number, info.time, info.duration, info.held != 0,
                        info.new_scene != 0, info.quality);
}

void feed_packet(Decoder& self, std::uint64_t number, nb::handle packet) {
  const ByteView view(packet);
  self.call([&](fbs_decoder* d) {
    check(d, fbs_decoder_feed_packet(d, number, view.bytes().data(), view.bytes().size()));
  });
}

std::vector<std::uint64_t> missing(Decoder& self, std::size_t most) {
  std::vector<std::uint64_t> out(most);
  std::size_t count = 0;
  self.call([&](fbs_decoder* d) { check(d, fbs_decoder_get_missing(d, out.data(), most, &count)); });
  out.resize(count);
  return out;
}

void draw(Decoder& self, const PlaneArray& y, const PlaneArray& u, const PlaneArray& v) {
  const fbs_picture picture = view_of(y, u, v);
  self.call([&](fbs_decoder* d) { check(d, fbs_decoder_draw(d, &picture)); });
}

nb::tuple tuple_of(const fbs_face_state& s) {
  std::vector<float> control(&s.control[0][0], &s.control[0][0] + std::size_t{2} * FBS_CONTROL_POINTS);
  return nb::make_tuple(s.pitch, s.yaw, s.roll, s.x, s.y, s.eye_distance,
                        owned_array(std::move(control), {FBS_CONTROL_POINTS, 2}));
}

using ControlArray =
    nb::ndarray<const float, nb::shape<FBS_CONTROL_POINTS, 2>, nb::c_contig, nb::device::cpu>;

/// @param pose  pitch, yaw, roll, x, y, eye distance
void draw_state(Decoder& self, const std::array<float, 6>& pose, const ControlArray& control,
                const PlaneArray& y, const PlaneArray& u, const PlaneArray& v) {
  fbs_face_state state{pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], {}};
  std::copy_n(control.data(), std::size_t{2} * FBS_CONTROL_POINTS, &state.control[0][0]);
  const fbs_picture picture = view_of(y, u, v);
  self.call([&](fbs_decoder* d) { check(d, fbs_decoder_draw_state(d, &state, &picture)); });
}

/// The answer of `question` about the picture; nothing without a face.
template <class Answer, class Question>
std::optional<Answer> ask(Decoder& self, Question&& question) {
  return self.call([&](fbs_decoder* d) -> std::optional<Answer> {
    Answer out{};
    const fbs_status status = question(d, out);
    if (status == FBS_NEED_DATA || status == FBS_ERROR_NO_FACE) return std::nullopt;
    check(d, status);
    return out;
  });
}

nb::object format(Decoder& self) {
  const auto f =
      ask<fbs_format>(self, [](fbs_decoder* d, auto& out) { return fbs_decoder_get_format(d, &out); });
  if (!f) return nb::none();
  return nb::make_tuple(f->width, f->height, f->frame_rate_num, f->frame_rate_den, f->pixel_aspect_num,
                        f->pixel_aspect_den, static_cast<int>(f->matrix), f->full_range != 0);
}

nb::object state(Decoder& self) {
  const auto s =
      ask<fbs_face_state>(self, [](fbs_decoder* d, auto& out) { return fbs_decoder_get_state(d, &out); });
  return s ? nb::object(tuple_of(*s)) : nb::none();
}

/// @param edit  members in the order of fbs_face_edit
nb::object edited_state(Decoder& self, const std::array<float, 7>& edit) {
  const fbs_face_edit changes{edit[0], edit[1], edit[2], edit[3], edit[4], edit[5], edit[6]};
  const auto s = ask<fbs_face_state>(self, [&](fbs_decoder* d, auto& out) {
    const fbs_status set = fbs_decoder_set_edit(d, &changes);
    const fbs_status got = set == FBS_OK ? fbs_decoder_get_state(d, &out) : set;
    (void)fbs_decoder_set_edit(d, nullptr);
    return got;
  });
  return s ? nb::object(tuple_of(*s)) : nb::none();
}

nb::object blendshapes(Decoder& self) {
  auto weights = ask<std::vector<float>>(self, [](fbs_decoder* d, auto& out) {
    out.resize(FBS_BLENDSHAPES);
    return fbs_decoder_get_blendshapes(d, out.data());
  });
  return weights ? owned_array(std::move(*weights), {FBS_BLENDSHAPES}) : nb::none();
}

/// x, y and confidence of each.
nb::object landmarks(Decoder& self) {
  const auto points = ask<Landmarks>(
      self, [](fbs_decoder* d, auto& out) { return fbs_decoder_get_landmarks(d, out.data()); });
  if (!points) return nb::none();
  std::vector<float> values;
  for (const fbs_landmark& point : *points) values.insert(values.end(), {point.x, point.y, point.confidence});
  return owned_array(std::move(values), {FBS_LANDMARKS, 3});
}

nb::object vertices(Decoder& self) {
  const auto points = ask<std::vector<fbs_vertex>>(self, [](fbs_decoder* d, auto& out) {
    std::size_t count = FBS_MAX_VERTICES;
    out.resize(count);
    const fbs_status status = fbs_decoder_get_vertices(d, out.data(), &count);
    out.resize(count);
    return status;
  });
  if (!points) return nb::none();
  std::vector<float> values;
  for (const fbs_vertex& point : *points) values.insert(values.end(), {point.x, point.y, point.z});
  return owned_array(std::move(values), {points->size(), 3});
}

nb::object find_scene(nb::handle stream, std::uint64_t time) {
  const ByteView view(stream);
  fbs_scene scene{};
  fbs_status status = FBS_OK;
  {
    const nb::gil_scoped_release others;
    status = fbs_find_scene(view.bytes().data(), view.bytes().size(), time, &scene);
  }
  if (status < 0) throw StatusError(status);
  if (status == FBS_END) return nb::none();
  return nb::make_tuple(scene.offset, scene.number, scene.time);
}

}  // namespace

void bind_decoder(nb::module_& module) {
  nb::class_<Decoder>(module, "Decoder")
      .def("__init__", open, nb::arg("threads"), nb::arg("max_pixels"))
      .def("close", &Decoder::close)
      .def("feed", feed, nb::arg("piece"))
      .def("feed_packet", feed_packet, nb::arg("number"), nb::arg("packet"))
      .def("missing", missing, nb::arg("most"))
      .def(
          "packets_lost",
          [](Decoder& self, std::uint64_t before) {
            self.call([&](fbs_decoder* d) { check(d, fbs_decoder_packets_lost(d, before)); });
          },
          nb::arg("before"))
      .def("skip_missing",
           [](Decoder& self) {
             return self.call([](fbs_decoder* d) { return check(d, fbs_decoder_skip_missing(d)); }) == FBS_OK;
           })
      .def("needs_scene",
           [](Decoder& self) {
             return self.call([](fbs_decoder* d) { return fbs_decoder_needs_scene(d); }) != 0;
           })
      .def("finish",
           [](Decoder& self) { self.call([](fbs_decoder* d) { check(d, fbs_decoder_finish(d)); }); })
      .def("reset", [](Decoder& self) { self.call([](fbs_decoder* d) { check(d, fbs_decoder_reset(d)); }); })
      .def("next", next)
      .def("draw", draw, nb::arg("y"), nb::arg("u"), nb::arg("v"))
      .def("format", format)
      .def("draw_state", draw_state, nb::arg("pose"), nb::arg("control"), nb::arg("y"), nb::arg("u"),
           nb::arg("v"))
      .def("state", state)
      .def("edited_state", edited_state, nb::arg("edit"))
      .def("blendshapes", blendshapes)
      .def("landmarks", landmarks)
      .def("vertices", vertices);
  module.def("find_scene", find_scene, nb::arg("stream"), nb::arg("time"));
}

}  // namespace fbs_python
