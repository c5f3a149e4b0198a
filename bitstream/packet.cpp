#include "bitstream/packet.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "bitstream/byte_io.h"
#include "bitstream/crc16.h"
#include "bitstream/packet_search.h"

namespace fbs {

void write_signature(std::vector<std::uint8_t>& stream) {
  stream.insert(stream.end(), kSignature.begin(), kSignature.end());
}

std::size_t write_packet(std::vector<std::uint8_t>& stream, PacketType type,
                         std::span<const std::uint8_t> payload) {
  assert(payload.size() <= kMaxPayload);
  const std::size_t begin = stream.size();
  ByteWriter writer(stream);
  writer.u8(static_cast<std::uint8_t>(type));
  writer.varint(payload.size());
  writer.bytes(payload);
  writer.u16(crc16(std::span(stream).subspan(begin)));
  return stream.size() - begin;
}

struct PacketReader::Impl {
  std::vector<std::uint8_t> buffer;
  std::uint64_t dropped = 0;  // bytes of the stream before `buffer`
  std::size_t position = 0;   // of next(), in `buffer`
  bool closed = false;
  bool begun = false;          // the signature has been read or is not required any more
  std::optional<Error> error;  // what next() returns until resync() finds a packet
  std::optional<PacketSearch> search;

  [[nodiscard]] std::span<const std::uint8_t> ahead() const { return std::span(buffer).subspan(position); }
  [[nodiscard]] std::uint64_t offset() const { return dropped + position; }

  tl::unexpected<Error> refuse(ErrorCode code, const char* text) {
    error = Error{code, text, offset()};
    return fail(*error);
  }

  Result<ReadResult> need_more(const char* text_at_end) {
    if (!closed) return ReadResult{ReadStatus::kNeedMore, {}};
    return refuse(ErrorCode::kTruncated, text_at_end);
  }

  Result<ReadResult> read_signature();
  Result<ReadResult> read_packet();
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
Result<ReadResult> PacketReader::Impl::read_packet() {
  const auto bytes = ahead();
  if (bytes.empty()) return ReadResult{closed ? ReadStatus::kEnd : ReadStatus::kNeedMore, {}};

  ByteReader reader(bytes);
  const std::uint8_t type = reader.u8();
  const std::uint64_t size = reader.varint();
  if (reader.malformed()) return refuse(ErrorCode::kInvalidStream, "packet has a damaged length");
  if (reader.past_end()) return need_more("stream ends inside a packet");
  if (size > kMaxPayload) return refuse(ErrorCode::kTooLarge, "packet is too large");

  const auto payload = reader.bytes(size);
  const std::size_t checked = reader.offset();
  const std::uint16_t check = reader.u16();
  if (reader.past_end()) return need_more("stream ends inside a packet");
  if (crc16(bytes.first(checked)) != check) return refuse(ErrorCode::kInvalidStream, "packet is damaged");

  const Packet packet{static_cast<PacketType>(type), offset(), payload, reader.offset()};
  position += packet.size;
  return ReadResult{ReadStatus::kPacket, packet};
}

PacketReader::PacketReader() : impl_(std::make_unique<Impl>()) {}
PacketReader::~PacketReader() = default;
PacketReader::PacketReader(PacketReader&&) noexcept = default;
PacketReader& PacketReader::operator=(PacketReader&&) noexcept = default;

void PacketReader::feed(std::span<const std::uint8_t> bytes) {
  Impl& s = *impl_;
  assert(!s.closed);
  // Drop what was read once it is the larger half, so that each byte is moved a bounded number of times.
  const std::size_t done = s.search ? s.search->first_open() : s.position;
  if (done > s.buffer.size() / 2) {
    s.buffer.erase(s.buffer.begin(), s.buffer.begin() + done);
    s.dropped += done;
    s.position -= std::min(done, s.position);
    if (s.search) s.search->drop_front(done);
  }
  s.buffer.insert(s.buffer.end(), bytes.begin(), bytes.end());
}

void PacketReader::close() {
  impl_->closed = true;
}

Result<ReadResult> PacketReader::next() {
  Impl& s = *impl_;
  if (s.error) return fail(*s.error);
  if (!s.begun) {
    auto signature = s.read_signature();
    if (!signature || !s.begun) return signature;
  }
  return s.read_packet();
}

Result<ReadResult> PacketReader::resync() {
  Impl& s = *impl_;
  if (!s.search) s.search.emplace(s.position + (s.error && s.begun ? 1 : 0));
  const auto found = s.search->find(s.buffer, s.closed);
  if (!found) {
    if (!s.closed) return ReadResult{ReadStatus::kNeedMore, {}};
    s.position = s.buffer.size();
  } else {
    s.position = *found;
  }
  s.begun = true;
  s.error.reset();
  s.search.reset();
  return s.read_packet();
}

std::uint64_t PacketReader::offset() const {
  return impl_->offset();
}

}  // namespace fbs
