#include "bitstream/payload/head_part_payload.h"

#include <cassert>

#include "bitstream/byte_io.h"

namespace fbs {

std::vector<std::uint8_t> encode_head_part(const HeadPart& part) {
  assert(part.size > 0 && part.size <= kMaxHead && part.symbol.size() == part.symbol_size());
  assert(part.symbols > 0 && part.symbols <= kMaxHeadSymbols && part.index >= 0 &&
         part.index < kMaxHeadParts);
  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  writer.u16(part.scene);
  writer.varint(part.passed.pictures);
  writer.varint(part.passed.time);
  writer.varint(part.size);
  writer.u8(static_cast<std::uint8_t>(part.symbols));
  writer.u8(static_cast<std::uint8_t>(part.index));
  writer.bytes(part.symbol);
  return payload;
}

Result<HeadPart> decode_head_part(std::span<const std::uint8_t> payload) {
  ByteReader reader(payload);
  HeadPart part;
  part.scene = reader.u16();
  part.passed = {reader.varint(), reader.varint()};
  const std::uint64_t size = reader.varint();
  part.symbols = reader.u8();
  part.index = reader.u8();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "a head part ends early");
  if (reader.malformed() || size == 0 || part.symbols == 0 || part.index >= kMaxHeadParts ||
      !can_last(part.passed.pictures, part.passed.time))
    return fail(ErrorCode::kInvalidStream, "a head part is damaged");
  if (size > kMaxHead || part.symbols > kMaxHeadSymbols || part.passed.pictures > kMaxPassedPictures)
    return fail(ErrorCode::kTooLarge, "a head is too large, or its scene too long");
  part.size = static_cast<std::size_t>(size);
  const auto symbol = reader.rest();
  if (symbol.size() < part.symbol_size()) return fail(ErrorCode::kTruncated, "a head part ends early");
  if (symbol.size() > part.symbol_size()) return fail(ErrorCode::kInvalidStream, "a head part is too long");
  part.symbol.assign(symbol.begin(), symbol.end());
  return part;
}

}  // namespace fbs
