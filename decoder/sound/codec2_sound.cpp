#include "decoder/sound/codec2_sound.h"

#include <algorithm>

#include "decoder/sound/codec2_handle.h"

namespace fbs {
namespace {

// Losses are concealed by repeating the last frame, ever fainter; silence after 100 ms.
constexpr std::int32_t kFadeSamples = kCodec2Rate / 10;

class Codec2Sound final : public SoundDecoder {
 public:
  Codec2Sound(Codec2Handle handle, const Codec2Mode& mode) : handle_(std::move(handle)), mode_(mode) {}

  [[nodiscard]] int sample_rate() const override { return kCodec2Rate; }
  [[nodiscard]] int channels() const override { return 1; }
  [[nodiscard]] std::size_t frame_samples() const override { return mode_.frame_samples; }

  Result<void> decode(std::span<const std::uint8_t> frame, std::vector<std::int16_t>& out) override {
    if (!frame.empty() && frame.size() != mode_.frame_bytes)
      return fail(ErrorCode::kInvalidStream, "a frame of Codec 2 has another size than its mode's");
    const std::size_t before = out.size();
    out.resize(before + mode_.frame_samples);
    if (frame.empty()) {
      conceal({out.data() + before, mode_.frame_samples});
      return {};
    }
    codec2_decode(handle_.get(), out.data() + before, frame.data());
    last_.assign(frame.begin(), frame.end());
    faded_ = 0;
    return {};
  }

  void reset() override {
    // This allocates a few kilobytes; if that fails, the old state continues.
    if (Codec2Handle fresh = create_codec2(mode_); fresh) handle_ = std::move(fresh);
    last_.clear();
    faded_ = 0;
  }

 private:
  /// @param samples  zeros
  void conceal(std::span<std::int16_t> samples) {
    if (last_.empty() || faded_ >= kFadeSamples) return;
    codec2_decode(handle_.get(), samples.data(), last_.data());
    for (std::int16_t& sample : samples) {
      sample = static_cast<std::int16_t>(sample * (kFadeSamples - faded_) / kFadeSamples);
      faded_ = std::min(faded_ + 1, kFadeSamples);
    }
  }

  Codec2Handle handle_;
  Codec2Mode mode_;
  std::vector<std::uint8_t> last_;  // frame that was decoded; empty: none yet
  std::int32_t faded_ = 0;          // samples concealed since
};

}  // namespace

Result<std::unique_ptr<SoundDecoder>> create_codec2_sound(const SoundSetup& setup) {
  const Codec2Mode* const mode = find_codec2_mode(setup.mode);
  if (mode == nullptr) return fail(ErrorCode::kUnsupported, "sound of Codec 2 in an unknown mode");
  if (setup.channels != 1)
    return fail(ErrorCode::kUnsupported, "sound of Codec 2 with more channels than one");
  if (setup.duration != mode->duration())
    return fail(ErrorCode::kInvalidStream, "frames of Codec 2 of another duration than their mode's");
  Codec2Handle handle = create_codec2(*mode);
  if (!handle) return fail(ErrorCode::kUnsupported, "this libcodec2 lacks the mode of the sound");
  return std::make_unique<Codec2Sound>(std::move(handle), *mode);
}

}  // namespace fbs
