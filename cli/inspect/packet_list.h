// The packets of a stream, one by one, without drawing anything: for `inspect --packets`.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fbs::cli {

inline constexpr const char* kDamage = "damage";  ///< type of an entry that is no packet

/// A packet, or damaged bytes between packets.
struct PacketEntry {
  std::uint64_t offset = 0;           ///< of the first byte in the stream
  std::uint64_t bytes = 0;            ///< the whole packet, or all that is skipped
  std::string type;                   ///< "setup", "geometry", ...; "type 9" if unknown; kDamage
  bool key = false;                   ///< coded without reference to an earlier packet of its type
  std::optional<std::uint64_t> time;  ///< of the first picture it concerns, 1/90000 s; none if not known
  std::string error;                  ///< what is wrong with it; empty: nothing
};

/// Lists a stream up to its end. Past damage it goes on where a decoder does, with the next setup or end
/// packet (SPEC 3.2); other packets of a scene in which something was lost are listed without their times.
/// AV1 data is not decoded.
///
/// The time of a setup packet is that of its scene, of a pattern packet that of the picture which its first
/// pattern shows, of a motion or blend packet that of the first picture it has, of geometry and surround that
/// of the first picture drawn with it, of the end packet the length of the stream.
/// @param stream  from its signature on
[[nodiscard]] std::vector<PacketEntry> list_packets(std::span<const std::uint8_t> stream);

}  // namespace fbs::cli
