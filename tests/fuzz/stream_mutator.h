// Changes to whole streams that know packets: bytes changed at random seldom get past the first check.
#pragma once

#include <functional>
#include <span>

#include "tests/fuzz/byte_mutator.h"

namespace fbs::fuzz {

/// A packet of any type and payload.
struct LoosePacket {
  std::uint8_t type = 0;
  Bytes payload;
  friend bool operator==(const LoosePacket&, const LoosePacket&) = default;
};

/// A stream whose packets need not be valid, nor in order.
struct LooseStream {
  std::vector<LoosePacket> packets;
  Bytes rest;  ///< after the last whole packet
};

/// Divides a stream into packets, whatever their checks. Ignores the signature.
[[nodiscard]] LooseStream read_loose(std::span<const std::uint8_t> stream);

/// The stream with its signature, and right checks for all packets.
[[nodiscard]] Bytes write_loose(const LooseStream& stream);

/// Where the packets of a stream begin, whatever their checks, and where the last whole one ends.
[[nodiscard]] std::vector<std::size_t> packet_borders(std::span<const std::uint8_t> stream);

/// Corrects signature and checks of all whole packets.
void repair_checks(Bytes& stream);

using MutateBytes = std::function<void(Bytes&, Random&)>;

/// Drops, repeats, swaps or alters packets, inserts some of `other`, or changes a field of a setup packet.
/// @param mutate  changes the bytes of a payload
void change_packets(LooseStream& stream, const LooseStream& other, Random& random, const MutateBytes& mutate);

/// A changed stream: packets, sometimes a length field or an early end; its checks are mostly right.
/// @param other   a stream to take packets from; may be the same
/// @param mutate  changes the bytes of a payload
[[nodiscard]] Bytes mutate_stream(std::span<const std::uint8_t> stream, std::span<const std::uint8_t> other,
                                  Random& random, const MutateBytes& mutate = mutate_bytes);

}  // namespace fbs::fuzz
