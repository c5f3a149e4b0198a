#include "states.h"

#include <fbs/fbs.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "byte_view.h"
#include "owned_array.h"
#include "status_error.h"

namespace nb = nanobind;

namespace fbs_python {
namespace {

struct CloseDecoder {
  void operator()(fbs_decoder* decoder) const { fbs_decoder_close(&decoder); }
};

/// One row per picture in each array; NaN where there is no face.
struct States {
  std::vector<std::uint64_t> number, time;
  std::vector<std::uint32_t> duration;
  std::vector<std::uint8_t> held, new_scene, has_face;
  std::vector<float> pose;       ///< pitch, yaw, roll, x, y, eye distance
  std::vector<float> control;    ///< x, y of each control point
  std::vector<float> landmarks;  ///< x, y, confidence of each landmark
  std::vector<float> blendshapes;

  void add(const fbs_decoder* decoder, const fbs_picture_info& info) {
    number.push_back(info.number);
    time.push_back(info.time);
    duration.push_back(info.duration);
    held.push_back(info.held != 0 ? 1 : 0);
    new_scene.push_back(info.new_scene != 0 ? 1 : 0);
    fbs_face_state state;
    std::array<fbs_landmark, FBS_LANDMARKS> points;
    std::array<float, FBS_BLENDSHAPES> weights;
    const bool seen = fbs_decoder_get_state(decoder, &state) == FBS_OK &&
                      fbs_decoder_get_landmarks(decoder, points.data()) == FBS_OK &&
                      fbs_decoder_get_blendshapes(decoder, weights.data()) == FBS_OK;
    has_face.push_back(seen ? 1 : 0);
    if (!seen) {
      constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
      pose.resize(pose.size() + 6, kNone);
      control.resize(control.size() + std::size_t{2} * FBS_CONTROL_POINTS, kNone);
      landmarks.resize(landmarks.size() + std::size_t{3} * FBS_LANDMARKS, kNone);
      blendshapes.resize(blendshapes.size() + FBS_BLENDSHAPES, kNone);
      return;
    }
    pose.insert(pose.end(), {state.pitch, state.yaw, state.roll, state.x, state.y, state.eye_distance});
    for (const auto& point : state.control) control.insert(control.end(), {point[0], point[1]});
    for (const fbs_landmark& point : points)
      landmarks.insert(landmarks.end(), {point.x, point.y, point.confidence});
    blendshapes.insert(blendshapes.end(), weights.begin(), weights.end());
  }
};

/// @param keep_going  continue after damage instead of throwing
States states_of(std::span<const std::uint8_t> stream, std::uint64_t max_pixels, bool keep_going) {
  fbs_decoder_settings settings;
  fbs_decoder_default_settings(&settings, sizeof settings);
  settings.max_pixels = max_pixels;
  fbs_decoder* opened = nullptr;
  if (const fbs_status status = fbs_decoder_open(&opened, &settings); status < 0) throw StatusError(status);
  const std::unique_ptr<fbs_decoder, CloseDecoder> decoder(opened);

  constexpr std::size_t kPiece = 1 << 16;  // bytes fed before the pictures in them are taken
  States out;
  for (;;) {
    fbs_picture_info info;
    fbs_status status = fbs_decoder_next(decoder.get(), &info);
    if (status == FBS_END) return out;
    if (status == FBS_OK) {
      out.add(decoder.get(), info);
    } else if (status == FBS_NEED_DATA) {
      const auto piece = stream.first(std::min(kPiece, stream.size()));
      stream = stream.subspan(piece.size());
      status = piece.empty() ? fbs_decoder_finish(decoder.get())
                             : fbs_decoder_feed(decoder.get(), piece.data(), piece.size());
    }
    if (status < 0 && (!keep_going || status == FBS_ERROR_NO_MEMORY))
      throw StatusError(status, fbs_decoder_error(decoder.get()), fbs_decoder_error_offset(decoder.get()));
  }
}

nb::dict read_states(nb::handle stream, std::uint64_t max_pixels, bool keep_going) {
  const ByteView view(stream);
  States states;
  {
    const nb::gil_scoped_release others;
    states = states_of(view.bytes(), max_pixels, keep_going);
  }
  const std::size_t n = states.number.size();
  nb::dict out;
  out["number"] = owned_array(std::move(states.number), {n});
  out["time"] = owned_array(std::move(states.time), {n});
  out["duration"] = owned_array(std::move(states.duration), {n});
  out["held"] = owned_array(std::move(states.held), {n});
  out["new_scene"] = owned_array(std::move(states.new_scene), {n});
  out["has_face"] = owned_array(std::move(states.has_face), {n});
  out["pose"] = owned_array(std::move(states.pose), {n, 6});
  out["control"] = owned_array(std::move(states.control), {n, FBS_CONTROL_POINTS, 2});
  out["landmarks"] = owned_array(std::move(states.landmarks), {n, FBS_LANDMARKS, 3});
  out["blendshapes"] = owned_array(std::move(states.blendshapes), {n, FBS_BLENDSHAPES});
  return out;
}

}  // namespace

void bind_states(nb::module_& module) {
  module.def("read_states", read_states, nb::arg("stream"), nb::arg("max_pixels"), nb::arg("keep_going"));
}

}  // namespace fbs_python
