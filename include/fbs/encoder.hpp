// fbs/encoder.h for C++17, as fbs/fbs.hpp.
//
//     auto settings = fbs::Encoder::default_settings();
//     settings.format.width = 352;
//     settings.format.height = 288;
//     fbs::Encoder encoder(settings);
//     for (const fbs_const_picture& picture : pictures) {
//       encoder.push(picture);
//       while (auto packet = encoder.pull()) write(packet->data, packet->size);
//     }
//     encoder.finish();
//     while (auto packet = encoder.pull()) write(packet->data, packet->size);
#ifndef FBS_ENCODER_HPP
#define FBS_ENCODER_HPP

#include <fbs/encoder.h>

#include <chrono>
#include <fbs/fbs.hpp>

namespace fbs {
inline namespace api {

/// An fbs_encoder. The functions are those of fbs/encoder.h, which describes them.
class Encoder {
 public:
  static fbs_encoder_settings default_settings() {
    fbs_encoder_settings settings;
    fbs_encoder_default_settings(&settings, sizeof settings);
    return settings;
  }
  explicit Encoder(const fbs_encoder_settings& settings)
      : encoder_(detail::open(fbs_encoder_open, settings)) {}

  void push(const fbs_const_picture& picture, std::uint32_t duration = 0) {
    check(fbs_encoder_push(get(), &picture, duration));
  }
  void push(const fbs_const_picture& picture, const fbs_stamp& stamp) {
    check(fbs_encoder_push_stamped(get(), &picture, &stamp));
  }
  void request_scene() { check(fbs_encoder_request_scene(get())); }
  void lose_patterns() { check(fbs_encoder_lose_patterns(get())); }
  void set_bitrate(double kbps) { check(fbs_encoder_set_bitrate(get(), kbps)); }
  void finish() { check(fbs_encoder_finish(get())); }

  /// Nothing: push more, or finish; after finish(): there is no more.
  std::optional<fbs_packet> pull() {
    fbs_packet out;
    if (check(fbs_encoder_pull(get(), &out)) != FBS_OK) return std::nullopt;
    return out;
  }

  /// fbs_encoder_wait()
  /// @return true: a packet is ready
  bool wait(std::chrono::milliseconds longest) {
    const auto most = static_cast<std::chrono::milliseconds::rep>(UINT32_MAX);
    const auto milliseconds = longest.count() < 0 ? 0 : longest.count() > most ? most : longest.count();
    return check(fbs_encoder_wait(get(), static_cast<std::uint32_t>(milliseconds))) == FBS_OK;
  }
  /// Of the packet pulled last: fbs_encoder_get_stamp().
  fbs_stamp stamp() const {
    fbs_stamp out{};
    out.struct_size = sizeof out;
    check(fbs_encoder_get_stamp(get(), &out));
    return out;
  }

  fbs_encoder_report report() const {
    fbs_encoder_report out;
    check(fbs_encoder_get_report(get(), &out));
    return out;
  }
  /// Nothing in a scene without a face.
  std::optional<std::array<fbs_landmark, FBS_LANDMARKS>> landmarks() const {
    std::array<fbs_landmark, FBS_LANDMARKS> out;
    const fbs_status status = fbs_encoder_get_landmarks(get(), out.data());
    if (status == FBS_ERROR_NO_FACE) return std::nullopt;
    check(status);
    return out;
  }

  /// For calls of C. Null after a move.
  fbs_encoder* get() const noexcept { return encoder_.get(); }

 private:
  struct Close {
    void operator()(fbs_encoder* encoder) const noexcept { fbs_encoder_close(&encoder); }
  };

  fbs_status check(fbs_status status) const {
    if (status < 0) throw Error(status, fbs_encoder_error(get()));
    return status;
  }

  std::unique_ptr<fbs_encoder, Close> encoder_;
};

}  // namespace api
}  // namespace fbs

#endif
