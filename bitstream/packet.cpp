#include "bitstream/packet.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "bitstream/byte_io.h"

namespace fbs {
namespace {

/// Whether a packet of this type is looked for behind damage. SPEC 3.2.
bool is_known(PacketType type) {
  return type >= PacketType::kSetup && type <= PacketType::kReturn;
}

}  // namespace

bool is_of_scene(PacketType type) {
  switch (type) {
    case PacketType::kWireFrame:
    case PacketType::kGeometry:
    case PacketType::kSurround:
    case PacketType::kPattern:
    case PacketType::kMotion:
    case PacketType::kBlend:
    case PacketType::kUnit:
      return true;
    default:
      return false;
  }
}

// SPEC 3.1
std::uint32_t CheckChain::of(std::span<const std::uint8_t> bytes, const Crc& crc) const {
  const std::uint32_t before = is_of_scene(static_cast<PacketType>(bytes[0])) ? check_ : kStart;
  return crc.of(bytes, crc.bits() == kCrc16.bits() ? before : before << 8 | 0xFF);
}

void CheckChain::add(PacketType type, std::span<const std::uint8_t> payload, std::uint32_t check) {
  if (type == PacketType::kReturn) {
    in_head_ = false;
    check_ = static_cast<std::uint16_t>(ByteReader(payload).varint());
    return;
  }
  if (type == PacketType::kSetup)
    in_head_ = true;
  else if (!in_head_ || !is_of_scene(type))
    return;
  check_ = static_cast<std::uint16_t>(check);
  if (type == PacketType::kPattern) in_head_ = false;
}

void write_signature(std::vector<std::uint8_t>& stream) {
  stream.insert(stream.end(), kSignature.begin(), kSignature.end());
}

std::uint32_t PacketWriter::write(std::vector<std::uint8_t>& stream, PacketType type,
                                  std::span<const std::uint8_t> payload) {
  assert(payload.size() <= kMaxPayload);
  const std::size_t begin = stream.size();
  ByteWriter writer(stream);
  writer.u8(static_cast<std::uint8_t>(type));
  writer.varint(payload.size());
  writer.bytes(payload);
  const Crc& crc = crc_of(payload.size());
  const std::uint32_t check = checks_.of(std::span(stream).subspan(begin), crc);
  checks_.add(type, payload, check);
  for (unsigned bits = crc.bits(); bits > 0; bits -= 8)
    writer.u8(static_cast<std::uint8_t>(check >> (bits - 8)));
  return check;
}

struct PacketReader::Impl {
  std::vector<std::uint8_t> buffer;
  std::uint64_t dropped = 0;  // bytes of the stream before `buffer`
  std::size_t position = 0;   // of next(), in `buffer`
  bool closed = false;
  bool begun = false;      // the signature has been read or is not required any more
  bool searching = false;  // for a packet behind the damage
  CheckChain checks;
  std::optional<PacketReader> head;  // read first

  [[nodiscard]] std::span<const std::uint8_t> ahead() const { return std::span(buffer).subspan(position); }
  [[nodiscard]] std::uint64_t offset() const { return dropped + position; }

  tl::unexpected<Error> refuse(ErrorCode code, const char* text) {
    searching = true;
    const std::uint64_t at = offset();
    if (begun) ++position;  // the search begins behind what is damaged; without a signature anywhere
    return fail(code, text, at);
  }

  Result<ReadResult> need_more(const char* text_at_end) {
    if (!closed) return ReadResult{ReadStatus::kNeedMore, {}};
    return refuse(ErrorCode::kTruncated, text_at_end);
  }

  Result<ReadResult> read_signature();
  /// @param repaired  repair() has changed it
  Result<ReadResult> read_packet(bool repaired = false);
  struct Check {
    std::uint32_t stored, difference;  ///< as it came, and that xor what it has to be
  };
  /// Reads the check of a packet that begins with `bytes`, behind its payload of this size.
  Check read_check(ByteReader& reader, std::span<const std::uint8_t> bytes, std::size_t payload) const;
  /// Inverts the wrong bit of a packet, if it is one.
  bool repair(const Packet& packet, const Check& check);
  Result<ReadResult> search();
};

// SPEC 3
Result<ReadResult> PacketReader::Impl::read_signature() {
  const auto bytes = ahead();
  const std::size_t size = std::min(bytes.size(), kSignature.size());
  const bool same = std::equal(bytes.begin(), bytes.begin() + size, kSignature.begin());
  if (!same || (closed && bytes.empty())) return refuse(ErrorCode::kNotFbs, "not an fbs stream");
  if (size < kSignature.size()) return need_more("stream ends inside its signature");
  position += kSignature.size();
  begun = true;
  return ReadResult{};
}

// SPEC 3.1
Result<ReadResult> PacketReader::Impl::read_packet(bool repaired) {
  const auto bytes = ahead();
  if (bytes.empty()) return ReadResult{closed ? ReadStatus::kEnd : ReadStatus::kNeedMore, {}};

  ByteReader reader(bytes);
  const std::uint8_t type = reader.u8();
  const std::uint64_t size = reader.varint();
  if (reader.malformed()) return refuse(ErrorCode::kInvalidStream, "packet has a damaged length");
  if (reader.past_end()) return need_more("stream ends inside a packet");
  if (size > kMaxPayload) return refuse(ErrorCode::kTooLarge, "packet is too large");

  const auto payload = reader.bytes(size);
  const Check check = read_check(reader, bytes, size);
  if (reader.past_end()) return need_more("stream ends inside a packet");
  const Packet packet{
      static_cast<PacketType>(type), offset(), payload, reader.offset(), repaired, check.stored};
  if (check.difference != 0) {
    if (repair(packet, check)) return read_packet(true);
    return refuse(ErrorCode::kInvalidStream, "packet is damaged, or its scene has lost its head");
  }
  position += packet.size;
  checks.add(packet.type, payload, check.stored);
  return ReadResult{ReadStatus::kPacket, packet};
}

PacketReader::Impl::Check PacketReader::Impl::read_check(ByteReader& reader,
                                                         std::span<const std::uint8_t> bytes,
                                                         std::size_t payload) const {
  const std::size_t checked = reader.offset();
  const Crc& crc = crc_of(payload);
  std::uint32_t stored = 0;
  for (unsigned bits = 0; bits < crc.bits(); bits += 8) stored = stored << 8 | reader.u8();
  if (reader.past_end()) return {};
  return {stored, checks.of(bytes.first(checked), crc) ^ stored};
}

// SPEC 3.2
bool PacketReader::Impl::repair(const Packet& packet, const Check& check) {
  if (packet.payload.size() > kMaxRepairedPayload) return false;
  const Crc& crc = crc_of(packet.payload.size());
  const auto bit = crc.wrong_bit(check.difference, 8 * packet.payload.size() + crc.bits());
  if (!bit) return false;
  std::uint8_t& byte = buffer[position + packet.size - 1 - *bit / 8];
  byte = static_cast<std::uint8_t>(byte ^ 1U << *bit % 8);
  return true;
}

// SPEC 3.2. The candidate that ends first is taken, so none has to wait for bytes that have not come.
Result<ReadResult> PacketReader::Impl::search() {
  std::size_t found = buffer.size(), end = buffer.size() + 1;
  std::optional<std::size_t> incomplete;  // first candidate that may still come
  for (std::size_t at = position; at < std::min(end, buffer.size()); ++at) {
    const auto bytes = std::span(buffer).subspan(at);
    const auto type = static_cast<PacketType>(bytes[0]);
    if (!is_known(type)) continue;
    ByteReader reader(bytes);
    (void)reader.u8();
    const std::uint64_t size = reader.varint();
    if (reader.malformed() || size > kMaxSearchedPayload) continue;
    (void)reader.bytes(size);
    const Check check = read_check(reader, bytes, size);
    if (reader.past_end()) {
      if (!incomplete) incomplete = at;
    } else if (at + reader.offset() < end && check.difference == 0) {
      found = at;
      end = at + reader.offset();
    }
  }
  if (found == buffer.size() && !closed) {
    position = incomplete.value_or(found);
    return ReadResult{};
  }
  position = found;
  begun = true;
  searching = false;
  return read_packet();
}

PacketReader::PacketReader(std::span<const std::uint8_t> stream) : PacketReader() {
  feed(stream);
  close();
}

PacketReader::PacketReader() : impl_(std::make_unique<Impl>()) {}
PacketReader::~PacketReader() = default;
PacketReader::PacketReader(PacketReader&&) noexcept = default;
PacketReader& PacketReader::operator=(PacketReader&&) noexcept = default;

void PacketReader::read_head(std::span<const std::uint8_t> packets) {
  impl_->head.emplace();
  impl_->head->feed(kSignature);
  impl_->head->feed(packets);
  impl_->head->close();
}

void PacketReader::feed(std::span<const std::uint8_t> bytes) {
  Impl& s = *impl_;
  assert(!s.closed);
  // Drop what was read once it is the larger half, so that each byte moves a bounded number of times.
  if (s.position > s.buffer.size() / 2) {
    s.buffer.erase(s.buffer.begin(), s.buffer.begin() + s.position);
    s.dropped += s.position;
    s.position = 0;
  }
  s.buffer.insert(s.buffer.end(), bytes.begin(), bytes.end());
}

bool PacketReader::begin_packet() {
  Impl& s = *impl_;
  const bool cut = !s.searching && s.position < s.buffer.size();
  s.position = s.buffer.size();
  s.searching = false;
  return cut;
}

void PacketReader::close() {
  impl_->closed = true;
}

Result<ReadResult> PacketReader::next() {
  Impl& s = *impl_;
  if (s.head) {
    auto read = s.head->next();
    if (!read) return fail(read.error().code, read.error().text, s.offset());
    if (read->status == ReadStatus::kPacket) {
      read->packet.in_parts = true;
      read->packet.offset = s.offset();
      return read;
    }
    s.checks = s.head->impl_->checks;
    s.head.reset();
  }
  if (s.searching) return s.search();
  if (!s.begun) {
    auto signature = s.read_signature();
    if (!signature || !s.begun) return signature;
  }
  return s.read_packet();
}

std::uint64_t PacketReader::offset() const {
  return impl_->offset();
}

}  // namespace fbs
