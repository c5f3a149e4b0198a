// Packets: a signature, then type, length, payload and check of each. SPEC 3.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/crc.h"
#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

inline constexpr std::array<std::uint8_t, 4> kSignature = {0x89, 'f', 'b', 's'};
inline constexpr std::size_t kMaxPayload = std::size_t{1} << 24;  ///< bytes
/// Shortest payload with a check of 24 bits; all shorter ones have 16.
inline constexpr std::size_t kLongPayload = 256;
/// Longest payload of which a wrong bit is found.
inline constexpr std::size_t kMaxRepairedPayload = 65535;

/// Appends the signature that begins every stream.
void write_signature(std::vector<std::uint8_t>& stream);

/// Whether a packet counts for the pictures of a scene.
[[nodiscard]] bool is_of_scene(PacketType type);

/// Whether a packet begins a scene or goes on with one.
[[nodiscard]] constexpr bool enters_scene(PacketType type) {
  return type == PacketType::kSetup || type == PacketType::kReturn;
}

/// With what the check of a packet begins. Through the head of a scene, up to its first pattern, checks run
/// on from packet to packet; every later packet of the scene begins with the check of that pattern packet. So
/// one that is lost does no harm to others, and none passes for a packet of another scene. A return packet
/// names that check. SPEC 3.1.
class CheckChain {
 public:
  /// The check of the next packet.
  /// @param bytes  its type, length and payload
  [[nodiscard]] std::uint32_t of(std::span<const std::uint8_t> bytes, const Crc& crc) const;
  /// Goes on behind a packet.
  void add(PacketType type, std::span<const std::uint8_t> payload, std::uint32_t check);

 private:
  static constexpr std::uint16_t kStart = 0xFFFF;
  std::uint16_t check_ = kStart;  // the last 16 bits of that of the last packet of the head
  bool in_head_ = true;
};

/// Writes packets in stream order. A setup packet, an end packet or sound may follow any writer's packets.
class PacketWriter {
 public:
  /// Appends the next packet.
  /// @param payload  at most kMaxPayload bytes (assert)
  /// @return its check
  std::uint32_t write(std::vector<std::uint8_t>& stream, PacketType type,
                      std::span<const std::uint8_t> payload);

 private:
  CheckChain checks_;
};

/// What checks a packet with this many bytes of payload.
[[nodiscard]] constexpr const Crc& crc_of(std::size_t payload) {
  return payload < kLongPayload ? kCrc16 : kCrc24;
}

/// Bytes of a packet with this many bytes of payload.
[[nodiscard]] constexpr std::size_t packet_size(std::size_t payload) {
  std::size_t size = payload + 2 + crc_of(payload).bits() / 8;
  for (; payload > 0x7F; payload >>= 7) ++size;
  return size;
}

/// Longest payload of a packet that is found behind damage. SPEC 3.2.
inline constexpr std::size_t kMaxSearchedPayload = 2047;  ///< bytes

/// One packet whose check is right, or has been once the one wrong bit was inverted. Its payload still has to
/// be parsed.
struct Packet {
  PacketType type{};                      ///< any byte; callers skip unknown types
  std::uint64_t offset = 0;               ///< of the type byte, from the start of the stream
  std::span<const std::uint8_t> payload;  ///< in the reader's memory, valid until the next feed()
  std::size_t size = 0;                   ///< bytes of the whole packet: type, length, payload and check
  bool repaired = false;                  ///< one wrong bit has been set right
  std::uint32_t check = 0;                ///< the last of its bytes, as they have to be
  bool in_parts = false;                  ///< from PacketReader::read_head(): it has no bytes of its own
};

enum class ReadStatus : std::uint8_t {
  kPacket,    ///< a packet was read
  kNeedMore,  ///< no error; feed more bytes, or close(), and ask again
  kEnd,       ///< closed, and the stream ended after a whole packet
};

struct ReadResult {
  ReadStatus status = ReadStatus::kNeedMore;
  Packet packet;  ///< set with kPacket
};

/// Divides a stream into packets. Bytes may arrive in pieces of any size, as from a pipe.
///
///   reader.feed(bytes);                 // or reader.close() at the end of the input
///   for (;;) {
///     auto read = reader.next();
///     if (!read) { report(read.error()); continue; }       // goes on behind the damage
///     if (read->status != ReadStatus::kPacket) break;
///     use(read->packet);
///   }
///
/// Memory: the bytes fed and not yet read; less than the largest packet if all packets are read before more
/// is fed.
class PacketReader {
 public:
  PacketReader();
  /// Reads a whole stream: feed(), then close().
  explicit PacketReader(std::span<const std::uint8_t> stream);
  ~PacketReader();
  PacketReader(PacketReader&&) noexcept;
  PacketReader& operator=(PacketReader&&) noexcept;
  PacketReader(const PacketReader&) = delete;
  PacketReader& operator=(const PacketReader&) = delete;

  /// These packets, from a setup packet on, are read next, and what follows belongs to their scene. Not while
  /// such packets are read.
  void read_head(std::span<const std::uint8_t> packets);

  /// Copies `bytes` and invalidates the payloads of earlier packets. Not after close() (assert).
  void feed(std::span<const std::uint8_t> bytes);

  /// What is fed next begins with a packet, whatever came before.
  /// @return whether that ended inside a packet, which is lost
  bool begin_packet();

  /// No more bytes will come.
  void close();

  /// Reads the next packet. One wrong bit of a payload or check is set right and is no error (SPEC 3.2). An
  /// error is reported once. The next call searches past the damage for a packet of a known type with the
  /// right check and at most kMaxSearchedPayload bytes (SPEC 3.2); a stream that is joined in its middle
  /// begins so, with kNotFbs.
  /// @return kNotFbs         the stream does not begin with the signature, or is empty
  ///         kTruncated      closed inside the signature or a packet; offset of that packet
  ///         kInvalidStream  check or length field wrong: the packet is damaged, or the head of its scene
  ///                         is incomplete; offset of the packet
  ///         kTooLarge       payload beyond kMaxPayload; offset of the packet
  [[nodiscard]] Result<ReadResult> next();

  /// Where next() or its search is, in bytes from the start of the stream.
  [[nodiscard]] std::uint64_t offset() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fbs
