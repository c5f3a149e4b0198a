// A track of Opus packets in our output. Part of the module fbs_av.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/sound_syntax.h"
#include "cli/video/av/av_muxer.h"
#include "cli/video/av/av_support.h"

namespace fbs {

/// Packets are copied into the container. The samples that a decoder leaves out at the start are given in
/// OpusHead (RFC 7845 5.1), and as CodecDelay in Matroska and as an edit list in MP4.
class AvOpusTrack {
 public:
  /// Before the muxer's write_header.
  /// @return ErrorCode::kUnsupported for another codec than Opus, and for a skip that OpusHead cannot hold
  static Result<AvOpusTrack> add(const SoundSetup& setup, AvMuxer& muxer);

  /// @param frame  a packet of Opus; nothing is written for an empty one
  /// @param begin  1/kSoundClock s, not before the end of the frame before
  Result<void> write(std::span<const std::uint8_t> frame, std::int64_t begin, AvMuxer& muxer);

 private:
  AvOpusTrack() = default;

  AvPacket packet_;
  AVStream* stream_ = nullptr;  ///< of the muxer
  std::int64_t duration_ = 0;   ///< of a packet, 1/kSoundClock s
  std::int64_t delay_ = 0;      ///< added to times for libav, 1/kSoundClock s
};

}  // namespace fbs
