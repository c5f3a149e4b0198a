// An encoder's bytes as packets, each with the first picture that needs it.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "common/result.h"

namespace fbs {

/// Follows a stream packet by packet, for numbers and durations of pictures only.
class PacketTimes {
 public:
  /// @return the position in the stream of the first picture that needs the packet; for an end packet, the
  /// end.
  ///         kInternal: our encoder does not write such a packet
  Result<StreamPosition> take(PacketType type, std::span<const std::uint8_t> payload);

 private:
  Result<void> begin_scene(std::span<const std::uint8_t> payload);
  Result<void> take_patterns(std::span<const std::uint8_t> payload);
  Result<void> take_motion(std::span<const std::uint8_t> payload);
  Result<void> take_blend(std::span<const std::uint8_t> payload);

  StreamPosition moved_;  // behind the last picture that has its motion
  StreamPosition shown_;  // behind the last picture that has everything
  // The current scene.
  Setup setup_;
  std::int32_t pictures_ = 0;
  std::deque<std::uint32_t> waiting_;  // durations of the pictures between shown_ and moved_
  PatternPacketReader patterns_;
  std::optional<MotionDecoder> motion_;
  BlendDecoder blend_;
};

struct QueuedPacket {
  std::span<const std::uint8_t> bytes;  ///< the whole packet; the first begins with the signature
  bool key = false;                     ///< a setup packet
  StreamPosition first;                 ///< PacketTimes::take()
};

/// Takes the bytes of a stream from its beginning on, and returns packets.
class PacketQueue {
 public:
  void add(std::span<const std::uint8_t> bytes);

  /// The next packet, valid until the next add(); nothing until it has arrived entirely.
  Result<std::optional<QueuedPacket>> next();

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t begin_ = 0;  // of the bytes not yet returned
  bool signed_ = false;    // the signature has been returned
  PacketTimes times_;
};

}  // namespace fbs
