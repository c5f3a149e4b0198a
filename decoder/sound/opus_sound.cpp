#include "decoder/sound/opus_sound.h"

#include <opus/opus.h>

namespace fbs {
namespace {

struct Deleter {
  void operator()(OpusDecoder* decoder) const { opus_decoder_destroy(decoder); }
};
using Handle = std::unique_ptr<OpusDecoder, Deleter>;

class OpusSound final : public SoundDecoder {
 public:
  OpusSound(Handle handle, const SoundSetup& setup)
      : handle_(std::move(handle)), channels_(setup.channels), duration_(setup.duration) {}

  [[nodiscard]] int sample_rate() const override { return kSoundClock; }
  [[nodiscard]] int channels() const override { return channels_; }
  [[nodiscard]] std::size_t frame_samples() const override { return static_cast<std::size_t>(duration_); }

  Result<void> decode(std::span<const std::uint8_t> frame, std::vector<std::int16_t>& out) override {
    if (!frame.empty()) {
      auto right = check(frame);
      if (!right) return right;
    }
    const std::size_t before = out.size();
    out.resize(before + frame_samples() * static_cast<std::size_t>(channels_));
    const int samples = opus_decode(handle_.get(), frame.empty() ? nullptr : frame.data(),
                                    static_cast<opus_int32>(frame.size()), out.data() + before, duration_, 0);
    if (samples == duration_) return {};
    out.resize(before);
    return fail(ErrorCode::kInvalidStream, "a frame of Opus is damaged");
  }

  void reset() override { opus_decoder_ctl(handle_.get(), OPUS_RESET_STATE); }

 private:
  [[nodiscard]] Result<void> check(std::span<const std::uint8_t> frame) const {
    if (frame.size() > kMaxSoundFrameBytes)
      return fail(ErrorCode::kInvalidStream, "a frame of Opus is longer than any can be");
    const int samples =
        opus_packet_get_nb_samples(frame.data(), static_cast<opus_int32>(frame.size()), kSoundClock);
    if (samples < 0) return fail(ErrorCode::kInvalidStream, "a frame of sound is none of Opus");
    if (samples != duration_)
      return fail(ErrorCode::kInvalidStream, "a frame of Opus has another duration than the stream says");
    return {};
  }

  Handle handle_;
  int channels_;
  std::int32_t duration_;  // 1/kSoundClock s, which is one sample
};

}  // namespace

Result<std::unique_ptr<SoundDecoder>> create_opus_sound(const SoundSetup& setup) {
  if (setup.channels != 1 && setup.channels != 2)
    return fail(ErrorCode::kUnsupported, "sound of Opus with neither one channel nor two");
  if (setup.mode != 0) return fail(ErrorCode::kUnsupported, "sound of Opus in an unknown mode");
  if (setup.duration < kMinOpusDuration || setup.duration > kMaxOpusDuration ||
      setup.duration % kMinOpusDuration != 0)
    return fail(ErrorCode::kInvalidStream, "frames of Opus of a duration that it does not have");
  int error = OPUS_OK;
  Handle handle(opus_decoder_create(kSoundClock, setup.channels, &error));
  if (!handle) return fail(ErrorCode::kInternal, "libopus makes no decoder");
  return std::make_unique<OpusSound>(std::move(handle), setup);
}

}  // namespace fbs
