// Frames of sound to samples. SPEC 4.9.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/sound_syntax.h"
#include "common/result.h"

namespace fbs {

/// The largest Opus packet: 48 frames of 1275 bytes and their lengths. RFC 7845, section 6.
inline constexpr std::size_t kMaxSoundFrameBytes = 61298;

/// The decoder of one codec. Samples have 16 bits, channels interleaved.
class SoundDecoder {
 public:
  SoundDecoder() = default;
  SoundDecoder(const SoundDecoder&) = delete;
  SoundDecoder& operator=(const SoundDecoder&) = delete;
  virtual ~SoundDecoder() = default;

  /// @return kUnsupported when this decoder does not know the codec, its mode or the number of channels;
  /// kInvalidStream when the codec has no such duration, or the skip is out of 0..kMaxSoundSkip
  static Result<std::unique_ptr<SoundDecoder>> create(const SoundSetup& setup);

  [[nodiscard]] virtual int sample_rate() const = 0;            ///< 48000 for Opus, 8000 for Codec 2
  [[nodiscard]] virtual int channels() const = 0;               ///< 1 or 2
  [[nodiscard]] virtual std::size_t frame_samples() const = 0;  ///< per channel and frame

  /// Appends exactly frame_samples() * channels() samples.
  /// @param frame  empty when lost: the sound before is continued, and fades
  /// @return kInvalidStream when it is not a frame of this codec or has another duration; `out` and later
  /// frames are then as without the call, as far as the codec can tell before it decodes
  virtual Result<void> decode(std::span<const std::uint8_t> frame, std::vector<std::int16_t>& out) = 0;

  /// Forgets the past: the next frame is from elsewhere.
  virtual void reset() = 0;
};

}  // namespace fbs
