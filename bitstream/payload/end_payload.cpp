#include "bitstream/payload/end_payload.h"

#include "bitstream/byte_io.h"

namespace fbs {

std::vector<std::uint8_t> encode_end(const End& end) {
  std::vector<std::uint8_t> payload;
  ByteWriter(payload).varint(end.pictures);
  return payload;
}

Result<End> decode_end(std::span<const std::uint8_t> payload) {
  ByteReader reader(payload);
  const End end{reader.varint()};  // SPEC 4.7
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "end packet ends early");
  if (reader.malformed()) return fail(ErrorCode::kInvalidStream, "end packet is damaged");
  if (end.pictures > kMaxStreamPictures) return fail(ErrorCode::kTooLarge, "too many pictures in the stream");
  return end;
}

}  // namespace fbs
