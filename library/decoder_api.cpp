// The decoder of fbs/fbs.h.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "common/workers.h"
#include "decoder/expression/expression_targets.h"
#include "decoder/scene/scene_face.h"
#include "decoder/stream/scene_index.h"
#include "decoder/stream/stream_decoder.h"
#include "fbs/fbs.h"
#include "library/boundary.h"
#include "library/caller_picture.h"
#include "library/decoder_watch.h"
#include "library/face_data.h"
#include "library/settings_struct.h"
#include "library/stream_entry.h"

namespace {

using namespace fbs;

static_assert(FBS_REORDER == LatePackets::kReorder);
static_assert(FBS_MAX_THREADS == 64, "a text names it");

constexpr const char* kNoPicture = "there is no picture yet";

constexpr fbs_decoder_settings kDefaults = {
    sizeof(fbs_decoder_settings), 0, 1, nullptr, nullptr, nullptr, nullptr};
/// sizeof(fbs_decoder_settings) in version 0.1.
constexpr std::size_t kFirstSize = offsetof(fbs_decoder_settings, max_pixels) + sizeof(std::uint64_t);

std::unique_ptr<StreamDecoder> new_stream(const fbs_decoder_settings& settings) {
  auto stream = std::make_unique<StreamDecoder>();
  if (settings.max_pixels > 0) stream->limit_pixels(settings.max_pixels);
  stream->use_threads(settings.threads, hooks_of(settings));
  return stream;
}

}  // namespace

struct fbs_decoder {  // NOLINT(readability-identifier-naming): the interface is C
  explicit fbs_decoder(const fbs_decoder_settings& s)
      : settings(s), watch(hooks_of(s)), stream(new_stream(s)) {
    watch.open(s.threads);
  }

  [[nodiscard]] bool has_picture() const { return !broken && stream->pictures() > 0; }

  [[nodiscard]] PictureView planes_of(const fbs_picture& caller) const;

  /// The face's state with the edit.
  [[nodiscard]] State shown(const SceneGeometry& face) const {
    return edit.any() ? edit.applied(stream->state(), face.geometry()) : stream->state();
  }
  /// Null where the edit changes nothing.
  [[nodiscard]] const SceneGeometry* edited_face() const {
    return edit.any() ? face_of(stream->scene()) : nullptr;
  }
  /// Draws the picture with the edit.
  [[nodiscard]] Result<void> render(Picture& out) const;
  [[nodiscard]] Result<void> render(const PictureView& out) const;

  /// Calls `body` with the face's geometry and the state shown, if there are any.
  /// @return the result of `body`
  template <class Body>
  fbs_status with_face(Body&& body) const;

  fbs_decoder_settings settings;
  DecoderWatch watch;
  std::unique_ptr<StreamDecoder> stream;  ///< never null
  StreamEntry entry{false};
  StateEdit edit;
  enum class Fed : std::uint8_t { kNothing, kBytes, kPackets } fed = Fed::kNothing;
  bool finished = false;
  bool broken = false;                  ///< an exception has left the stream in an unknown state
  Picture picture;                      ///< returned to the caller
  std::optional<StateEdit> drawn_with;  ///< the edit of `picture`, if that is the one announced last
  mutable BlendshapeMeasure blendshapes;
  mutable LastError error;
};

Result<void> fbs_decoder::render(Picture& out) const {
  const SceneGeometry* const face = edited_face();
  return face != nullptr ? stream->render_state(shown(*face), std::nullopt, out) : stream->render(out);
}

Result<void> fbs_decoder::render(const PictureView& out) const {
  const SceneGeometry* const face = edited_face();
  return face != nullptr ? stream->render_state(shown(*face), out) : stream->render(out);
}

template <class Body>
fbs_status fbs_decoder::with_face(Body&& body) const {
  return guarded(error, [&] {
    if (!has_picture()) return error.set_argument(kNoPicture);
    const SceneGeometry* const face = face_of(stream->scene());
    if (face == nullptr) return error.set(FBS_ERROR_NO_FACE, "the scene has no face");
    return body(*face, shown(*face));
  });
}

PictureView fbs_decoder::planes_of(const fbs_picture& caller) const {
  const auto plane = [&](std::size_t k) {
    const PlaneSize size = plane_size(stream->format(), k);
    return PlaneView(caller.data[k], size.width, size.height, caller.stride[k]);
  };
  return PictureView(plane(0), plane(1), plane(2));
}

void fbs_decoder_default_settings(fbs_decoder_settings* settings, size_t struct_size) {
  give_defaults(kDefaults, settings, struct_size, kFirstSize);
}

fbs_status fbs_decoder_open(fbs_decoder** out, const fbs_decoder_settings* settings) {
  if (out == nullptr) return FBS_ERROR_ARGUMENT;
  *out = nullptr;
  fbs_decoder_settings taken = kDefaults;
  LastError error;
  const fbs_status status = guarded(error, [&] {
    if (settings != nullptr && !take_settings(*settings, kFirstSize, taken))
      return error.set_argument(kOtherSettings);
    if (taken.threads < 0 || taken.threads > FBS_MAX_THREADS)
      return error.set_argument("threads outside 0..64");
    if (taken.threads == 0) taken.threads = std::min(core_count(), FBS_MAX_THREADS);
    *out = std::make_unique<fbs_decoder>(taken).release();
    return FBS_OK;
  });
  error.copy_to(taken.open_error);
  return status;
}

void fbs_decoder_close(fbs_decoder** decoder) {
  close_object(decoder);
}

namespace {

/// @param kind  of what is fed: a stream has one
/// @param feed  of bytes that may be fed
template <class Feed>
fbs_status checked_feed(fbs_decoder* decoder, fbs_decoder::Fed kind, const uint8_t* bytes, size_t size,
                        Feed&& feed) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  if (bytes == nullptr && size > 0) return d.error.set_argument(kNullPointer);
  if (d.finished) return d.error.set_argument("bytes after fbs_decoder_finish()");
  if (d.fed != fbs_decoder::Fed::kNothing && d.fed != kind)
    return d.error.set_argument("fbs_decoder_feed() and fbs_decoder_feed_packet() for the same stream");
  if (d.broken || size == 0) return FBS_OK;
  return guarded(d.error, [&] {
    feed(d, std::span(bytes, size));
    d.fed = kind;
    return FBS_OK;
  });
}

}  // namespace

fbs_status fbs_decoder_feed(fbs_decoder* decoder, const uint8_t* bytes, size_t size) {
  return checked_feed(decoder, fbs_decoder::Fed::kBytes, bytes, size,
                      [](fbs_decoder& d, auto data) { d.entry.feed(*d.stream, data); });
}

fbs_status fbs_decoder_feed_packet(fbs_decoder* decoder, uint64_t number, const uint8_t* bytes, size_t size) {
  if (decoder != nullptr && number == std::numeric_limits<uint64_t>::max())
    return decoder->error.set_argument("there is no packet of this number");
  return checked_feed(decoder, fbs_decoder::Fed::kPackets, bytes, size,
                      [number](fbs_decoder& d, auto data) { d.stream->feed_packet(number, data); });
}

fbs_status fbs_decoder_get_missing(fbs_decoder* decoder, uint64_t* out, size_t most, size_t* count) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  if (count == nullptr || (out == nullptr && most > 0)) return d.error.set_argument(kNullPointer);
  return guarded(d.error, [&] {
    const auto missing = d.stream->missing_packets(most);
    std::copy(missing.begin(), missing.end(), out);
    *count = missing.size();
    return FBS_OK;
  });
}

fbs_status fbs_decoder_packets_lost(fbs_decoder* decoder, uint64_t before) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  decoder->stream->give_up_packets(before);
  return FBS_OK;
}

fbs_status fbs_decoder_skip_missing(fbs_decoder* decoder) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  return decoder->stream->skip_missing() ? FBS_OK : FBS_NEED_DATA;
}

int fbs_decoder_needs_scene(const fbs_decoder* decoder) {
  return decoder != nullptr && !decoder->broken && decoder->stream->needs_scene() ? 1 : 0;
}

fbs_status fbs_decoder_finish(fbs_decoder* decoder) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  if (d.finished) return FBS_OK;
  return guarded(d.error, [&] {
    if (!d.broken) d.entry.close(*d.stream);
    d.finished = true;
    return FBS_OK;
  });
}

fbs_status fbs_decoder_next(fbs_decoder* decoder, fbs_picture_info* info) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  if (d.broken) return FBS_END;
  d.broken = true;  // unless this returns
  return guarded(d.error, [&] {
    const auto status = d.stream->next();
    d.broken = false;
    if (!status) {
      const std::uint64_t offset = d.entry.fed_offset(status.error().byte_offset);
      d.watch.note_error(status.error(), offset);
      return d.error.set(status_of(status.error().code), status.error().text.c_str(), offset);
    }
    if (*status != DecodeStatus::kPicture) return *status == DecodeStatus::kEnd ? FBS_END : FBS_NEED_DATA;
    if (!d.stream->held()) d.drawn_with.reset();
    d.watch.note_picture(*d.stream);
    if (info != nullptr)
      *info = {d.stream->position().pictures,
               d.stream->position().time,
               d.stream->duration(),
               d.stream->held() ? 1 : 0,
               !d.stream->held() && d.stream->state().picture == 0 &&
                       d.stream->scene().setup.keeps == SceneKeeping::kNone
                   ? 1
                   : 0,
               static_cast<int>(d.stream->quality())};
    return FBS_OK;
  });
}

fbs_status fbs_decoder_reset(fbs_decoder* decoder) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  return guarded(d.error, [&] {
    d.stream = new_stream(d.settings);
    d.entry = StreamEntry(true);
    d.watch.reset();
    d.fed = fbs_decoder::Fed::kNothing;
    d.finished = d.broken = false;
    d.drawn_with.reset();
    d.error.clear();
    return FBS_OK;
  });
}

fbs_status fbs_decoder_set_edit(fbs_decoder* decoder, const fbs_face_edit* edit) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  const auto wanted = edit_of(edit != nullptr ? *edit : fbs_face_edit{});
  if (!wanted) return decoder->error.set_argument("the edit has something that is not a number");
  decoder->edit = *wanted;
  return FBS_OK;
}

fbs_status fbs_decoder_get_picture(fbs_decoder* decoder, fbs_const_picture* out) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  if (out == nullptr) return d.error.set_argument(kNullPointer);
  if (!d.has_picture()) return d.error.set_argument(kNoPicture);
  return guarded(d.error, [&] {
    if (d.drawn_with != d.edit) {
      d.drawn_with.reset();
      if (const auto drawn = d.render(d.picture); !drawn) return d.error.set(drawn.error());
      d.drawn_with = d.edit;
    }
    *out = {static_cast<uint32_t>(d.picture.width()), static_cast<uint32_t>(d.picture.height()), {}, {}};
    const Plane* const planes[] = {&d.picture.y, &d.picture.u, &d.picture.v};
    for (std::size_t k = 0; k < 3; ++k) {
      out->data[k] = planes[k]->samples.data();
      out->stride[k] = planes[k]->width;
    }
    return FBS_OK;
  });
}

fbs_status fbs_decoder_draw(fbs_decoder* decoder, const fbs_picture* picture) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  if (picture == nullptr) return d.error.set_argument(kNullPointer);
  if (!d.has_picture()) return d.error.set_argument(kNoPicture);
  if (const char* const fault = fault_of(*picture, d.stream->format())) return d.error.set_argument(fault);
  return guarded(d.error, [&] {
    const auto drawn = d.render(d.planes_of(*picture));
    return drawn ? FBS_OK : d.error.set(drawn.error());
  });
}

fbs_status fbs_decoder_draw_state(fbs_decoder* decoder, const fbs_face_state* state,
                                  const fbs_picture* picture) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_decoder& d = *decoder;
  if (state == nullptr || picture == nullptr) return d.error.set_argument(kNullPointer);
  if (!d.has_picture()) return d.error.set_argument(kNoPicture);
  if (const char* const fault = fault_of(*picture, d.stream->format())) return d.error.set_argument(fault);
  return d.with_face([&](const SceneGeometry&, const State&) {
    const auto wanted = state_of(*state, d.stream->state());
    if (!wanted) return d.error.set_argument("a number of the state is beyond the limits of the format");
    const auto drawn = d.stream->render_state(*wanted, d.planes_of(*picture));
    return drawn ? FBS_OK : d.error.set(drawn.error());
  });
}

fbs_status fbs_decoder_get_format(const fbs_decoder* decoder, fbs_format* out) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return decoder->error.set_argument(kNullPointer);
  const VideoFormat& format = decoder->stream->format();
  if (decoder->broken || format.width == 0) return FBS_NEED_DATA;
  *out = caller_format(format);
  return FBS_OK;
}

fbs_status fbs_decoder_get_state(const fbs_decoder* decoder, fbs_face_state* out) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return decoder->error.set_argument(kNullPointer);
  return decoder->with_face([&](const SceneGeometry&, const State& state) {
    *out = face_state(state);
    return FBS_OK;
  });
}

fbs_status fbs_decoder_get_landmarks(const fbs_decoder* decoder, fbs_landmark* out) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return decoder->error.set_argument(kNullPointer);
  return decoder->with_face([&](const SceneGeometry& face, const State& state) {
    write_landmarks(face, state, std::span<fbs_landmark, kLandmarkCount>(out, kLandmarkCount));
    return FBS_OK;
  });
}

fbs_status fbs_decoder_get_blendshapes(const fbs_decoder* decoder, float* out) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return decoder->error.set_argument(kNullPointer);
  return decoder->with_face([&](const SceneGeometry& face, const State& state) {
    const std::vector<double> weights = decoder->blendshapes(face.geometry(), state);
    std::transform(weights.begin(), weights.end(), out, [](double w) { return static_cast<float>(w); });
    return FBS_OK;
  });
}

fbs_status fbs_decoder_get_vertices(const fbs_decoder* decoder, fbs_vertex* out, size_t* count) {
  if (decoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr || count == nullptr) return decoder->error.set_argument(kNullPointer);
  const std::size_t room = *count;
  *count = 0;
  return decoder->with_face([&](const SceneGeometry& face, const State& state) {
    *count = face.geometry().positions.size();
    if (*count > room) return decoder->error.set_argument("there is no room for the vertices");
    write_vertices(face, state, {out, *count});
    return FBS_OK;
  });
}

const char* fbs_blendshape_name(size_t index) {
  if (index >= FBS_BLENDSHAPES) return nullptr;
  LastError ignored;
  const char* name = nullptr;
  const fbs_status status = guarded(ignored, [&] {
    name = blendshape_names()[index].c_str();
    return FBS_OK;
  });
  return status == FBS_OK ? name : nullptr;
}

const char* fbs_decoder_error(const fbs_decoder* decoder) {
  return decoder != nullptr ? decoder->error.text() : "";
}

uint64_t fbs_decoder_error_offset(const fbs_decoder* decoder) {
  return decoder != nullptr ? decoder->error.offset() : 0;
}

fbs_status fbs_find_scene(const uint8_t* bytes, size_t size, uint64_t time, fbs_scene* out) {
  if ((bytes == nullptr && size > 0) || out == nullptr) return FBS_ERROR_ARGUMENT;
  LastError ignored;
  return guarded(ignored, [&] {
    const auto scenes = index_scenes({bytes, size});
    const SceneEntry* const scene = scene_at(scenes, time);
    if (scene == nullptr) return FBS_END;
    *out = {scene->offset, scene->before.pictures, scene->before.time};
    return FBS_OK;
  });
}
