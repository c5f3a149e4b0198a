#include "encoder/sound/codec2_coder.h"

#include <algorithm>
#include <string>

#include "decoder/sound/codec2_handle.h"

namespace fbs {
namespace {

/// Delay of the decoded sound, samples, in every mode. libcodec2 analyses a window of 40 ms that ends with
/// the frame's samples and describes its centre, 20 ms earlier, which a decoder plays at the frame's end.
constexpr std::int32_t kDelay = 160;

class Codec2Coder final : public SoundEncoder {
 public:
  Codec2Coder(Codec2Handle handle, const SoundSetup& setup, const Codec2Mode& mode)
      : SoundEncoder(setup, kCodec2Rate), handle_(std::move(handle)), frame_bytes_(mode.frame_bytes) {}

 private:
  Result<std::vector<std::uint8_t>> encode(std::span<std::int16_t> samples) override {
    std::vector<std::uint8_t> out(frame_bytes_);
    codec2_encode(handle_.get(), out.data(), samples.data());
    return out;
  }

  Codec2Handle handle_;
  std::size_t frame_bytes_;
};

/// The mode of the highest rate up to `bitrate`; null when there is none. Never 1300, whose frames are as
/// long as those of mode 1400 and no clearer.
const Codec2Mode* mode_of_rate(int bitrate) {
  const auto modes = codec2_modes();
  const auto found = std::find_if(modes.begin(), modes.end(),
                                  [&](const Codec2Mode& mode) { return mode.sent_bitrate() <= bitrate; });
  return found == modes.end() ? nullptr : &*found;
}

}  // namespace

Result<std::unique_ptr<SoundEncoder>> create_codec2_coder(const SoundSettings& settings) {
  if (settings.channels != 1) return fail(ErrorCode::kInvalidArgument, "Codec 2 has one channel");
  const Codec2Mode* const mode = mode_of_rate(settings.bitrate);
  if (mode == nullptr)
    return fail(ErrorCode::kInvalidArgument,
                "Codec 2 takes at least " + std::to_string(codec2_modes().back().bitrate) + " bit/s");
  Codec2Handle handle = create_codec2(*mode);
  if (!handle) return fail(ErrorCode::kUnsupported, "this libcodec2 lacks the mode of the rate");
  const SoundSetup setup{SoundCodec::kCodec2, 1, mode->bitrate, mode->duration(), kDelay * kCodec2Ticks};
  return std::make_unique<Codec2Coder>(std::move(handle), setup, *mode);
}

}  // namespace fbs
