// An encoder's bytes as packets, each with the first picture that needs it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/result.h"
#include "decoder/stream/packet_times.h"

namespace fbs {

struct QueuedPacket {
  std::span<const std::uint8_t> bytes;  ///< whole packet; that of the first begins with the signature
  PacketType type{};
  bool joinable = false;       ///< a setup packet at which the stream can be joined
  std::uint64_t pictures = 0;  ///< that can be shown once it has arrived
  StreamPosition first;        ///< of the first picture that needs it; of the end packet, the end
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
  PacketTimes times_;
};

}  // namespace fbs
