#include "encoder/sound/opus_coder.h"

#include <opus/opus.h>

#include <string>

namespace fbs {
namespace {

constexpr int kTicksOfMs = kSoundClock / 1000;
constexpr std::size_t kRoom = 4000;  // bytes; what libopus recommends for a packet

struct Deleter {
  void operator()(OpusEncoder* encoder) const { opus_encoder_destroy(encoder); }
};
using Handle = std::unique_ptr<OpusEncoder, Deleter>;

class OpusCoder final : public SoundEncoder {
 public:
  OpusCoder(Handle handle, const SoundSetup& setup)
      : SoundEncoder(setup, kSoundClock), handle_(std::move(handle)) {}

 private:
  Result<std::vector<std::uint8_t>> encode(std::span<std::int16_t> samples) override {
    std::vector<std::uint8_t> out(kRoom);
    const opus_int32 bytes = opus_encode(handle_.get(), samples.data(), setup().duration, out.data(),
                                         static_cast<opus_int32>(out.size()));
    if (bytes <= 0)
      return fail(ErrorCode::kInternal, std::string("libopus encodes no frame: ") + opus_strerror(bytes));
    out.resize(static_cast<std::size_t>(bytes));
    return out;
  }

  Handle handle_;
};

Result<void> check(const SoundSettings& settings) {
  if (settings.channels != 1 && settings.channels != 2)
    return fail(ErrorCode::kInvalidArgument, "sound has one channel or two");
  if (settings.bitrate < kMinOpusBitrate || settings.bitrate > kMaxOpusBitrate)
    return fail(ErrorCode::kInvalidArgument, "Opus takes " + std::to_string(kMinOpusBitrate) + " to " +
                                                 std::to_string(kMaxOpusBitrate) + " bit/s");
  switch (settings.frame_ms) {
    case 10:
    case 20:
    case 40:
    case 60:
      return {};
    default:
      return fail(ErrorCode::kInvalidArgument, "frames of Opus last 10, 20, 40 or 60 ms");
  }
}

/// With DTX, pauses cost a byte or two a frame.
bool configure(OpusEncoder* encoder, const SoundSettings& settings) {
  const auto set = [encoder](auto... request) { return opus_encoder_ctl(encoder, request...) == OPUS_OK; };
  return set(OPUS_SET_BITRATE(settings.bitrate)) && set(OPUS_SET_VBR(1)) && set(OPUS_SET_VBR_CONSTRAINT(1)) &&
         set(OPUS_SET_SIGNAL(OPUS_SIGNAL_VOICE)) && set(OPUS_SET_COMPLEXITY(10)) && set(OPUS_SET_DTX(1)) &&
         set(OPUS_SET_INBAND_FEC(0)) && set(OPUS_SET_LSB_DEPTH(16));
}

}  // namespace

Result<std::unique_ptr<SoundEncoder>> create_opus_coder(const SoundSettings& settings) {
  const auto right = check(settings);
  if (!right) return fail(right.error());
  int error = OPUS_OK;
  Handle handle(opus_encoder_create(kSoundClock, settings.channels, OPUS_APPLICATION_VOIP, &error));
  opus_int32 delay = 0;  // samples at 48 kHz
  if (!handle || !configure(handle.get(), settings) ||
      opus_encoder_ctl(handle.get(), OPUS_GET_LOOKAHEAD(&delay)) != OPUS_OK)
    return fail(ErrorCode::kInternal, "libopus makes no encoder");
  const SoundSetup setup{SoundCodec::kOpus, settings.channels, 0, settings.frame_ms * kTicksOfMs, delay};
  return std::make_unique<OpusCoder>(std::move(handle), setup);
}

}  // namespace fbs
