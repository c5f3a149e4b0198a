// The packets of a stream, one by one: what they are, and when.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fbs {

inline constexpr const char* kDamage = "damage";  ///< type of an entry that is not a packet

/// A packet, or damaged bytes between packets.
struct PacketEntry {
  std::uint64_t offset = 0;           ///< of the first byte in the stream
  std::uint64_t bytes = 0;            ///< the whole packet, or all that is skipped
  std::string type;                   ///< "setup", "geometry", ...; "type 99" if unknown; kDamage
  bool key = false;                   ///< TimedPacket::key
  std::optional<std::uint64_t> time;  ///< TimedPacket::time; none with an error
  std::string error;                  ///< its fault; empty: none
  bool repaired = false;              ///< Packet::repaired
};

/// Lists a stream up to its end. After damage it continues like a decoder, with the next packet whose check
/// is right (SPEC 3.2); what needs a lost one is listed without a time. AV1 data is not decoded.
/// @param stream  from its signature on
[[nodiscard]] std::vector<PacketEntry> list_packets(std::span<const std::uint8_t> stream);

}  // namespace fbs
