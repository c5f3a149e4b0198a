// Packets: how a stream is divided. Signature, then type, length, payload, check. SPEC 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

inline constexpr std::array<std::uint8_t, 4> kSignature = {0x89, 'f', 'b', 's'};
inline constexpr std::size_t kMaxPayload = std::size_t{1} << 24;  ///< bytes

/// Appends the signature that begins every stream.
void write_signature(std::vector<std::uint8_t>& stream);

/// Appends one packet.
/// @param payload  at most kMaxPayload bytes (assert)
/// @return number of bytes appended: payload + 4 up to 127 bytes, + 5 up to 16383, + 6 and 7 beyond
std::size_t write_packet(std::vector<std::uint8_t>& stream, PacketType type,
                         std::span<const std::uint8_t> payload);

/// One packet whose check is right. Its payload still has to be parsed.
struct Packet {
  PacketType type{};                      ///< any byte; callers skip what they do not know
  std::uint64_t offset = 0;               ///< of the type byte, from the start of the stream
  std::span<const std::uint8_t> payload;  ///< in the reader's memory: valid until the next call of feed()
  std::size_t size = 0;                   ///< bytes of the whole packet: type, length, payload and check
};

enum class ReadStatus : std::uint8_t {
  kPacket,    ///< a packet was read
  kNeedMore,  ///< nothing wrong; feed more bytes, or close(), and ask again
  kEnd,       ///< closed, and the stream ended after a whole packet
};

struct ReadResult {
  ReadStatus status = ReadStatus::kNeedMore;
  Packet packet;  ///< set with kPacket
};

/// Divides a stream into packets. Bytes may come in pieces of any size, as from a pipe.
///
///   reader.feed(bytes);                 // or reader.close() at the end of the input
///   for (;;) {
///     auto read = reader.next();        // or resync() after an error, to go on behind the damage
///     if (!read || read->status != ReadStatus::kPacket) break;
///     use(read->packet);
///   }
///
/// Memory: what was fed and not yet taken; a caller that takes all packets before feeding again keeps it
/// below the largest packet.
class PacketReader {
 public:
  PacketReader();
  ~PacketReader();
  PacketReader(PacketReader&&) noexcept;
  PacketReader& operator=(PacketReader&&) noexcept;

  /// Copies `bytes`. Ends the life of payloads handed out before. Not after close() (assert).
  void feed(std::span<const std::uint8_t> bytes);

  /// No more bytes will come.
  void close();

  /// Reads the next packet. After an error it returns the same error again until resync() finds a packet.
  /// @return kNotFbs         the stream does not begin with the signature, or is empty
  ///         kTruncated      closed inside the signature or a packet; offset of that packet
  ///         kInvalidStream  check or length field wrong; offset of the packet
  ///         kTooLarge       payload beyond kMaxPayload; offset of the packet
  [[nodiscard]] Result<ReadResult> next();

  /// After an error of next(): searches behind the damaged place for a packet of a known type with the right
  /// check and at most kMaxSearchedPayload bytes, and reads it; next() goes on behind it. May also be called
  /// first of all, to join a stream in its middle.
  /// @return kPacket; kNeedMore (call resync() again after feeding); kEnd when closed and nothing was found
  [[nodiscard]] Result<ReadResult> resync();

  /// Where next() stands, in bytes from the start of the stream.
  [[nodiscard]] std::uint64_t offset() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fbs
