// fbs/fbs.h for C++17: objects that close themselves, exceptions for errors. All of it is inline.
//
//     fbs::Decoder decoder;
//     for (;;) {
//       const fbs_status status = decoder.next();
//       if (status == FBS_END) break;
//       if (status == FBS_OK) show(decoder.picture());
//       else if (auto bytes = read(); !bytes.empty()) decoder.feed(bytes.data(), bytes.size());
//       else decoder.finish();
//     }
#ifndef FBS_FBS_HPP
#define FBS_FBS_HPP

#include <fbs/fbs.h>

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace fbs {
inline namespace api {

/// what(): one line for a user.
class Error : public std::runtime_error {
 public:
  Error(fbs_status status, const std::string& text, std::uint64_t offset = 0)
      : std::runtime_error(text.empty() ? fbs_status_text(status) : text), status_(status), offset_(offset) {}

  fbs_status status() const noexcept { return status_; }
  /// fbs_decoder_error_offset()
  std::uint64_t offset() const noexcept { return offset_; }

 private:
  fbs_status status_;
  std::uint64_t offset_;
};

/// Has settings of a decoder or an encoder log to `sink`, called with an fbs_log_level and a line of text. It
/// outlives the object, and any thread may call it: fbs_log. Takes the member `user`.
template <class Settings, class Sink>
void log_to(Settings& settings, Sink& sink) {
  settings.user = &sink;
  settings.log = [](void* user, int level, const char* text) noexcept {
    (*static_cast<Sink*>(user))(static_cast<fbs_log_level>(level), text);
  };
}

namespace detail {

/// Opens an object, or throws with the reason. The caller's `open_error` is not written to.
template <class Object, class Settings>
Object* open(fbs_status (*how)(Object**, const Settings*), Settings settings) {
  char why[FBS_ERROR_SIZE] = "";
  settings.open_error = why;
  Object* opened = nullptr;
  const fbs_status status = how(&opened, &settings);
  if (status < 0) throw Error(status, why);
  return opened;
}

}  // namespace detail

/// An fbs_decoder. The functions are those of fbs/fbs.h, which describes them.
class Decoder {
 public:
  static fbs_decoder_settings default_settings() {
    fbs_decoder_settings settings;
    fbs_decoder_default_settings(&settings, sizeof settings);
    return settings;
  }
  explicit Decoder(const fbs_decoder_settings& settings = default_settings())
      : decoder_(detail::open(fbs_decoder_open, settings)) {}

  void feed(const std::uint8_t* bytes, std::size_t size) { check(fbs_decoder_feed(get(), bytes, size)); }
  void feed_packet(std::uint64_t number, const std::uint8_t* bytes, std::size_t size) {
    check(fbs_decoder_feed_packet(get(), number, bytes, size));
  }
  /// Numbers of packets to be asked for, at most so many.
  std::vector<std::uint64_t> missing(std::size_t most) const {
    std::vector<std::uint64_t> out(most);
    std::size_t count = 0;
    check(fbs_decoder_get_missing(get(), out.data(), most, &count));
    out.resize(count);
    return out;
  }
  void packets_lost(std::uint64_t before) { check(fbs_decoder_packets_lost(get(), before)); }
  /// @return whether there was one to go on with
  bool skip_missing() { return check(fbs_decoder_skip_missing(get())) == FBS_OK; }
  bool needs_scene() const noexcept { return fbs_decoder_needs_scene(get()) != 0; }
  void finish() { check(fbs_decoder_finish(get())); }
  void reset() { check(fbs_decoder_reset(get())); }

  /// @return FBS_OK, FBS_NEED_DATA or FBS_END. After an exception the next call goes on behind the damage.
  fbs_status next(fbs_picture_info* info = nullptr) { return check(fbs_decoder_next(get(), info)); }

  void set_edit(const fbs_face_edit& edit) { check(fbs_decoder_set_edit(get(), &edit)); }

  fbs_const_picture picture() {
    fbs_const_picture out;
    check(fbs_decoder_get_picture(get(), &out));
    return out;
  }
  void draw(const fbs_picture& picture) { check(fbs_decoder_draw(get(), &picture)); }
  void draw(const fbs_face_state& state, const fbs_picture& picture) {
    check(fbs_decoder_draw_state(get(), &state, &picture));
  }

  /// Nothing until the setup has arrived.
  std::optional<fbs_format> format() const { return ask<fbs_format>(fbs_decoder_get_format); }

  // Nothing in a scene without a face.
  std::optional<fbs_face_state> state() const { return ask<fbs_face_state>(fbs_decoder_get_state); }
  std::optional<std::array<float, FBS_BLENDSHAPES>> blendshapes() const {
    return ask<std::array<float, FBS_BLENDSHAPES>>(
        [](const fbs_decoder* d, auto* out) { return fbs_decoder_get_blendshapes(d, out->data()); });
  }
  std::optional<std::array<fbs_landmark, FBS_LANDMARKS>> landmarks() const {
    return ask<std::array<fbs_landmark, FBS_LANDMARKS>>(
        [](const fbs_decoder* d, auto* out) { return fbs_decoder_get_landmarks(d, out->data()); });
  }
  std::optional<std::vector<fbs_vertex>> vertices() const {
    return ask<std::vector<fbs_vertex>>([](const fbs_decoder* d, auto* out) {
      std::size_t count = FBS_MAX_VERTICES;
      out->resize(count);
      const fbs_status status = fbs_decoder_get_vertices(d, out->data(), &count);
      out->resize(count);
      return status;
    });
  }

  /// For calls of C. Null after a move.
  fbs_decoder* get() const noexcept { return decoder_.get(); }

 private:
  struct Close {
    void operator()(fbs_decoder* decoder) const noexcept { fbs_decoder_close(&decoder); }
  };

  fbs_status check(fbs_status status) const {
    if (status < 0) throw Error(status, fbs_decoder_error(get()), fbs_decoder_error_offset(get()));
    return status;
  }
  template <class Answer, class Question>
  std::optional<Answer> ask(Question&& question) const {
    Answer out;
    const fbs_status status = question(get(), &out);
    if (status == FBS_NEED_DATA || status == FBS_ERROR_NO_FACE) return std::nullopt;
    check(status);
    return out;
  }

  std::unique_ptr<fbs_decoder, Close> decoder_;
};

}  // namespace api
}  // namespace fbs

#endif
