#include "decoder/stream/stream_length.h"

#include "bitstream/packet.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"

namespace fbs {

std::optional<std::uint64_t> stream_length(std::span<const std::uint8_t> stream) {
  PacketReader reader(stream);
  std::optional<Setup> last;
  StreamPosition before;  // the last stretch of a scene
  std::optional<std::uint64_t> pictures;
  for (;;) {
    const auto read = reader.next();
    if (!read) continue;
    if (read->status != ReadStatus::kPacket) break;
    if (read->packet.type == PacketType::kSetup)
      if (const auto setup = decode_setup(read->packet.payload)) {
        last = *setup;
        before = last->before;
      }
    if (read->packet.type == PacketType::kReturn)
      if (const auto to = decode_return(read->packet.payload)) before = to->before;
    if (read->packet.type == PacketType::kEnd)
      if (const auto end = decode_end(read->packet.payload)) pictures = end->pictures;
  }
  if (!last || !pictures || *pictures < before.pictures) return std::nullopt;
  return before.time + (*pictures - before.pictures) * nominal_duration(last->format.frame_rate);
}

}  // namespace fbs
