#include "library/packet_queue.h"

#include "bitstream/byte_io.h"

namespace fbs {
namespace {

tl::unexpected<Error> not_ours() {
  return fail(ErrorCode::kInternal, "the encoder wrote a packet that cannot be read");
}

}  // namespace

void PacketQueue::add(std::span<const std::uint8_t> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<QueuedPacket>> PacketQueue::next() {
  const auto ahead = std::span(std::as_const(bytes_)).subspan(begin_);
  ByteReader reader(ahead);
  if (!times_.has_setup()) (void)reader.bytes(kSignature.size());
  const auto type = static_cast<PacketType>(reader.u8());
  const auto payload = reader.bytes(reader.varint());
  std::uint32_t check = 0;
  for (const std::uint8_t byte : reader.bytes(crc_of(payload.size()).bits() / 8)) check = check << 8 | byte;
  if (reader.malformed()) return not_ours();
  if (reader.past_end()) return std::nullopt;
  const std::uint64_t before = times_.released().pictures;
  const auto timed = times_.take({type, 0, payload, reader.offset(), false, check});
  if (!timed) return not_ours();
  begin_ += reader.offset();
  return QueuedPacket{ahead.first(reader.offset()), type, type == PacketType::kSetup && timed->key,
                      times_.released().pictures - before, timed->first};
}

}  // namespace fbs
