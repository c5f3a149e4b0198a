#include "encoder/sound/opus_coder.h"

#include <opus/opus.h>

#include <algorithm>
#include <array>
#include <string>

namespace fbs {
namespace {

constexpr int kTicksOfMs = kSoundClock / 1000;
constexpr std::size_t kRoom = 4000;  // bytes; what libopus recommends for a packet
constexpr std::size_t kPause = 2;    // bytes; DTX frames are no longer than this

/// Long frames of libopus 1.3 fall short of low rates by up to a fifth. Requests the unspent bits again,
/// within a second and up to a quarter of the rate.
class UnspentBits {
 public:
  UnspentBits(int bitrate, std::int32_t duration) : bitrate_(bitrate), duration_(duration) {}

  /// Records a coded frame of a voice.
  void add(std::size_t bytes) {
    const std::int64_t spent = static_cast<std::int64_t>(bytes) * 8;
    unspent_ += std::int64_t{bitrate_} * duration_ / kSoundClock - spent;
    unspent_ = std::clamp<std::int64_t>(unspent_, 0, bitrate_ / 4);
  }

  /// bit/s to request.
  [[nodiscard]] opus_int32 bitrate() const { return bitrate_ + static_cast<opus_int32>(unspent_); }

 private:
  int bitrate_;
  std::int32_t duration_;     // of a frame, 1/kSoundClock s
  std::int64_t unspent_ = 0;  // bits
};

struct Deleter {
  void operator()(OpusEncoder* encoder) const { opus_encoder_destroy(encoder); }
};
using Handle = std::unique_ptr<OpusEncoder, Deleter>;

class OpusCoder final : public SoundEncoder {
 public:
  OpusCoder(Handle handle, const SoundSetup& setup, const SoundSettings& settings)
      : SoundEncoder(setup, settings.sample_rate),
        handle_(std::move(handle)),
        unspent_(settings.bitrate, setup.duration) {}

 private:
  Result<std::vector<std::uint8_t>> encode(std::span<std::int16_t> samples) override {
    std::vector<std::uint8_t> out(kRoom);
    const opus_int32 bytes =
        opus_encode(handle_.get(), samples.data(), static_cast<int>(samples.size()) / setup().channels,
                    out.data(), static_cast<opus_int32>(out.size()));
    if (bytes <= 0)
      return fail(ErrorCode::kInternal, std::string("libopus encodes no frame: ") + opus_strerror(bytes));
    out.resize(static_cast<std::size_t>(bytes));
    if (out.size() > kPause) {
      unspent_.add(out.size());
      opus_encoder_ctl(handle_.get(), OPUS_SET_BITRATE(unspent_.bitrate()));
    }
    return out;
  }

  Handle handle_;
  UnspentBits unspent_;
};

Result<void> check(const SoundSettings& settings) {
  if (settings.channels != 1 && settings.channels != 2)
    return fail(ErrorCode::kInvalidArgument, "sound has one channel or two");
  if (settings.bitrate < kMinOpusBitrate || settings.bitrate > kMaxOpusBitrate)
    return fail(ErrorCode::kInvalidArgument, "Opus takes " + std::to_string(kMinOpusBitrate) + " to " +
                                                 std::to_string(kMaxOpusBitrate) + " bit/s");
  constexpr std::array kRates{8000, 12000, 16000, 24000, 48000};
  if (std::ranges::find(kRates, settings.sample_rate) == kRates.end())
    return fail(ErrorCode::kInvalidArgument, "Opus takes no samples at such a rate");
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

/// With DTX, pauses cost a byte or two per frame.
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
  Handle handle(opus_encoder_create(settings.sample_rate, settings.channels, OPUS_APPLICATION_VOIP, &error));
  opus_int32 delay = 0;  // samples
  if (!handle || !configure(handle.get(), settings) ||
      opus_encoder_ctl(handle.get(), OPUS_GET_LOOKAHEAD(&delay)) != OPUS_OK)
    return fail(ErrorCode::kInternal, "libopus makes no encoder");
  const SoundSetup setup{SoundCodec::kOpus, settings.channels, 0, settings.frame_ms * kTicksOfMs,
                         delay * (kSoundClock / settings.sample_rate)};
  return std::make_unique<OpusCoder>(std::move(handle), setup, settings);
}

}  // namespace fbs
