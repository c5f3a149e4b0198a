// The packets of a stream, one by one, without drawing anything: what they are, and when.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bitstream/packet.h"

namespace fbs {

inline constexpr const char* kDamage = "damage";  ///< type of an entry that is no packet

/// A packet, or damaged bytes between packets.
struct PacketEntry {
  std::uint64_t offset = 0;           ///< of the first byte in the stream
  std::uint64_t bytes = 0;            ///< the whole packet, or all that is skipped
  std::string type;                   ///< "setup", "geometry", ...; "type 99" if unknown; kDamage
  bool key = false;                   ///< coded without reference to an earlier packet of its type
  std::optional<std::uint64_t> time;  ///< of the first picture it concerns, 1/90000 s; none if not known
  std::string error;                  ///< what is wrong with it; empty: nothing
};

/// Reads packets in the order of a stream. AV1 data is not decoded.
class PacketLister {
 public:
  PacketLister();
  ~PacketLister();
  PacketLister(PacketLister&&) noexcept;
  PacketLister& operator=(PacketLister&&) noexcept;
  PacketLister(const PacketLister&) = delete;
  PacketLister& operator=(const PacketLister&) = delete;

  /// Reads the next packet.
  PacketEntry take(const Packet& packet);
  /// What comes before the next setup or end packet is of no use.
  void lose();
  /// End of the pictures that may be shown once all that was read has come, 1/90000 s.
  [[nodiscard]] std::uint64_t released() const;
  /// Number of these pictures, those before the stream was joined included.
  [[nodiscard]] std::uint64_t released_pictures() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Lists a stream up to its end. Past damage it goes on where a decoder does, with the next setup or end
/// packet (SPEC 3.2); other packets of a scene in which something was lost are listed without their times.
/// AV1 data is not decoded.
///
/// The time of a setup packet is that of its scene, of a pattern packet that of the picture which its first
/// pattern shows, of a motion or blend packet that of the first picture it has, of geometry and surround that
/// of the first picture drawn with it, of sound that of its first sample, of the end packet the length of the
/// stream.
/// @param stream  from its signature on
[[nodiscard]] std::vector<PacketEntry> list_packets(std::span<const std::uint8_t> stream);

}  // namespace fbs
