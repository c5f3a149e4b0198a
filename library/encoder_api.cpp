// The encoder of fbs/encoder.h.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "encoder/encoder.h"
#include "fbs/encoder.h"
#include "library/boundary.h"
#include "library/caller_picture.h"
#include "library/encoder_settings.h"
#include "library/packet_queue.h"
#include "library/picture_stamps.h"
#include "library/settings_struct.h"

namespace {

using namespace fbs;

Picture copy_of(const fbs_const_picture& picture, const VideoFormat& format) {
  Picture out(format.width, format.height);
  Plane* const planes[] = {&out.y, &out.u, &out.v};
  for (std::size_t k = 0; k < 3; ++k)
    for (int y = 0; y < planes[k]->height; ++y)
      std::copy_n(picture.data[k] + y * picture.stride[k], planes[k]->width, planes[k]->row(y));
  return out;
}

}  // namespace

struct fbs_encoder {  // NOLINT(readability-identifier-naming): the interface is C
  enum class Phase { kPushing, kFinished, kFailed };

  fbs_encoder(const VideoFormat& f, Encoder e, const Hooks& h)
      : format(f), hooks(h), encoder(std::move(e)), stamps(nominal_duration(f.frame_rate)) {}

  /// Calls `body`, which encodes. If it fails, the encoding has ended; after an exception the encoder's state
  /// is undefined.
  template <class Body>
  fbs_status encode(Body&& body);

  /// Takes the next packet out of the queue, if it is ready and none has been taken.
  /// @return as fbs_encoder_pull()
  fbs_status look_for_packet();

  VideoFormat format;
  Hooks hooks;
  Encoder encoder;
  PacketQueue packets;
  std::optional<QueuedPacket> next;  ///< to be pulled
  PictureStamps stamps;
  std::optional<std::uint64_t> pulled{};  ///< QueuedPacket::first of the packet pulled last
  std::uint64_t shown = 0;                ///< pictures that can be shown with the packets pulled
  Phase phase = Phase::kPushing;
  mutable LastError error;
};

template <class Body>
fbs_status fbs_encoder::encode(Body&& body) {
  const Phase before = std::exchange(phase, Phase::kFailed);
  return guarded(error, [&] {
    const Result<void> done = body();
    if (done) {
      phase = before;
      return FBS_OK;
    }
    hooks.say(LogLevel::kError, done.error().text);
    packets.add(encoder.take());
    return error.set(done.error());
  });
}

fbs_status fbs_encoder::look_for_packet() {
  for (const bool added : {false, true}) {
    if (next) return FBS_OK;
    if (added && phase == Phase::kFailed) break;
    if (added) packets.add(encoder.take());
    auto packet = packets.next();
    if (!packet) return error.set(packet.error());
    next = *packet;
  }
  if (next) return FBS_OK;
  return phase == Phase::kPushing ? FBS_NEED_DATA : FBS_END;
}

void fbs_encoder_default_settings(fbs_encoder_settings* settings, size_t struct_size) {
  give_defaults(kEncoderDefaults, settings, struct_size, kFirstEncoderSettingsSize);
}

fbs_status fbs_encoder_open(fbs_encoder** out, const fbs_encoder_settings* settings) {
  if (out == nullptr) return FBS_ERROR_ARGUMENT;
  *out = nullptr;
  fbs_encoder_settings taken = kEncoderDefaults;
  LastError error;
  const fbs_status status = guarded(error, [&] {
    if (settings == nullptr) return error.set_argument(kNullPointer);
    if (!take_settings(*settings, kFirstEncoderSettingsSize, taken))
      return error.set_argument(kOtherSettings);
    const Hooks hooks = hooks_of(taken);
    const auto refused = [&](const Error& why) {
      hooks.say(LogLevel::kError, why.text);
      return error.set(why);
    };
    const auto input = encoder_input(taken);
    if (!input) return refused(input.error());
    auto encoder = Encoder::create(input->format, input->settings);
    if (!encoder) return refused(encoder.error());
    *out = std::make_unique<fbs_encoder>(input->format, std::move(*encoder), hooks).release();
    return FBS_OK;
  });
  error.copy_to(taken.open_error);
  return status;
}

void fbs_encoder_close(fbs_encoder** encoder) {
  close_object(encoder);
}

fbs_status fbs_encoder_push(fbs_encoder* encoder, const fbs_const_picture* picture, uint32_t duration) {
  fbs_stamp stamp = kNoStamp;
  stamp.duration = duration;
  return fbs_encoder_push_stamped(encoder, picture, &stamp);
}

fbs_status fbs_encoder_push_stamped(fbs_encoder* encoder, const fbs_const_picture* picture,
                                    const fbs_stamp* stamp) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_encoder& e = *encoder;
  if (picture == nullptr) return e.error.set_argument(kNullPointer);
  if (e.phase != fbs_encoder::Phase::kPushing) return e.error.set_argument("the encoding has ended");
  fbs_stamp taken = kNoStamp;
  if (stamp != nullptr && !take_settings(*stamp, kFirstStampSize, taken))
    return e.error.set_argument("a stamp of another version: struct_size, or an unknown member");
  if (const char* const fault = e.stamps.fault_of(taken)) return e.error.set_argument(fault);
  if (const char* const fault = fault_of(*picture, e.format)) return e.error.set_argument(fault);
  return e.encode([&] { return e.encoder.push(copy_of(*picture, e.format), e.stamps.add(taken)); });
}

namespace {

/// Changes something of an encoding that goes on.
template <class Change>
fbs_status change(fbs_encoder* encoder, Change&& how) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_encoder& e = *encoder;
  if (e.phase != fbs_encoder::Phase::kPushing) return e.error.set_argument("the encoding has ended");
  const fbs_status status = e.encode([&] { return how(e.encoder); });
  if (status == FBS_ERROR_ARGUMENT) e.phase = fbs_encoder::Phase::kPushing;  // nothing has changed
  return status;
}

}  // namespace

fbs_status fbs_encoder_request_scene(fbs_encoder* encoder) {
  return change(encoder, [](Encoder& e) { return e.request_scene(); });
}

fbs_status fbs_encoder_set_bitrate(fbs_encoder* encoder, double kbps) {
  return change(encoder, [&](Encoder& e) { return e.set_bitrate(kbps); });
}

fbs_status fbs_encoder_lose_patterns(fbs_encoder* encoder) {
  return change(encoder, [](Encoder& e) { return e.lose_patterns(); });
}

fbs_status fbs_encoder_finish(fbs_encoder* encoder) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_encoder& e = *encoder;
  if (e.phase != fbs_encoder::Phase::kPushing) return e.error.set_argument("the encoding has ended");
  e.phase = fbs_encoder::Phase::kFinished;
  return e.encode([&] { return e.encoder.finish(); });
}

fbs_status fbs_encoder_pull(fbs_encoder* encoder, fbs_packet* out) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_encoder& e = *encoder;
  if (out == nullptr) return e.error.set_argument(kNullPointer);
  return guarded(e.error, [&] {
    if (const fbs_status status = e.look_for_packet(); status != FBS_OK) return status;
    const QueuedPacket p = *std::exchange(e.next, std::nullopt);
    e.pulled = p.first.pictures;
    e.stamps.forget(e.shown);
    e.shown += p.pictures;
    *out = {p.bytes.data(),
            p.bytes.size(),
            static_cast<int>(p.type),
            p.joinable ? 1 : 0,
            static_cast<std::uint32_t>(p.pictures),
            p.first.pictures,
            p.first.time};
    return FBS_OK;
  });
}

fbs_status fbs_encoder_wait(fbs_encoder* encoder, uint32_t milliseconds) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_encoder& e = *encoder;
  return guarded(e.error, [&] {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    fbs_status status = e.look_for_packet();
    while (status == FBS_NEED_DATA && e.encoder.wait(until)) status = e.look_for_packet();
    return status;
  });
}

fbs_status fbs_encoder_get_stamp(const fbs_encoder* encoder, fbs_stamp* out) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return encoder->error.set_argument(kNullPointer);
  if (out->struct_size < kFirstStampSize) return encoder->error.set_argument("a stamp without its size");
  const fbs_stamp* const stamp = encoder->pulled ? encoder->stamps.of(*encoder->pulled) : nullptr;
  if (stamp == nullptr) return encoder->error.set_argument("no packet that belongs to a picture");
  give_defaults(*stamp, out, out->struct_size, kFirstStampSize);
  return FBS_OK;
}

fbs_status fbs_encoder_get_report(const fbs_encoder* encoder, fbs_encoder_report* out) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return encoder->error.set_argument(kNullPointer);
  return guarded(encoder->error, [&] {
    const EncodingReport& report = encoder->encoder.report();
    *out = {report.pictures, report.without_face, report.cuts, report.scenes};
    return FBS_OK;
  });
}

fbs_status fbs_encoder_get_landmarks(const fbs_encoder* encoder, fbs_landmark* out) {
  if (encoder == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return encoder->error.set_argument(kNullPointer);
  return guarded(encoder->error, [&] {
    if (encoder->phase == fbs_encoder::Phase::kFailed || encoder->encoder.report().pictures == 0)
      return encoder->error.set_argument("there is no picture");
    const PictureAnalysis& analysis = encoder->encoder.analysis();
    if (!analysis.face) return encoder->error.set(FBS_ERROR_NO_FACE, "the scene has no face");
    const float confidence = analysis.followed ? static_cast<float>(analysis.confidence) : 0;
    for (std::size_t k = 0; k < kLandmarkCount; ++k) {
      const glm::dvec2 at = analysis.vertices[vertex_of_landmark(k)];
      out[k] = {static_cast<float>(at.x), static_cast<float>(at.y), confidence};
    }
    return FBS_OK;
  });
}

const char* fbs_encoder_error(const fbs_encoder* encoder) {
  return encoder != nullptr ? encoder->error.text() : "";
}
