// Samples to frames of sound. SPEC 4.9.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/sound_syntax.h"
#include "common/result.h"

namespace fbs {

inline constexpr int kMinOpusBitrate = 6000, kMaxOpusBitrate = 64000;  ///< bit/s

struct SoundSettings {
  SoundCodec codec = SoundCodec::kOpus;
  int channels = 1;  ///< 1 or 2; 1 for Codec 2
  /// bit/s. For Opus kMinOpusBitrate..kMaxOpusBitrate, the mean while somebody speaks. For Codec 2 at least
  /// 1200: selects the mode of the highest rate that is not above. Its frames' whole bytes count: mode 1300
  /// takes as many as 1400, which is chosen instead.
  int bitrate = 12000;
  int frame_ms = 60;  ///< for Opus: 10, 20, 40 or 60; long ones cost fewer bits, and as much delay
  int sample_rate = kSoundClock;  ///< of the samples added: for Opus 8000, 12000, 16000, 24000 or 48000; for
                                  ///< Codec 2 always 8000
};

/// Codes sound frame by frame.
class SoundEncoder {
 public:
  using Frames = std::vector<std::vector<std::uint8_t>>;

  SoundEncoder() = default;
  SoundEncoder(const SoundEncoder&) = delete;
  SoundEncoder& operator=(const SoundEncoder&) = delete;
  virtual ~SoundEncoder() = default;

  /// @return kInvalidArgument when a setting is out of range
  static Result<std::unique_ptr<SoundEncoder>> create(const SoundSettings& settings);

  /// What a decoder must know. Its skip is the codec's delay: the first sample added has time 0.
  [[nodiscard]] const SoundSetup& setup() const { return setup_; }
  /// Sample rate for add().
  [[nodiscard]] int sample_rate() const { return sample_rate_; }

  /// Adds samples and appends the complete frames.
  /// @param samples  any number, channels interleaved; may end with any channel
  Result<void> add(std::span<const std::int16_t> samples, Frames& frames);

  /// Appends the last frames, after which a decoder has given all samples; none when there were no samples.
  /// Nothing may be added afterwards.
  Result<void> finish(Frames& frames);

 protected:
  SoundEncoder(const SoundSetup& setup, int sample_rate) : setup_(setup), sample_rate_(sample_rate) {}

 private:
  /// @param samples  of one frame
  virtual Result<std::vector<std::uint8_t>> encode(std::span<std::int16_t> samples) = 0;
  Result<void> encode_waiting(Frames& frames);
  /// Samples of all channels in `ticks` of 1/kSoundClock s.
  [[nodiscard]] std::size_t samples_of(std::int32_t ticks) const;

  SoundSetup setup_;
  int sample_rate_ = 0;
  std::vector<std::int16_t> waiting_;  // less than a frame
  bool added_ = false;
};

}  // namespace fbs
