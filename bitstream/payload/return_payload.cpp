#include "bitstream/payload/return_payload.h"

#include "bitstream/byte_io.h"

namespace fbs {
namespace {

constexpr std::uint64_t kMaxCheck = 0xFFFFFF;

}  // namespace

std::vector<std::uint8_t> encode_return(const Return& to) {
  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  writer.varint(to.scene);
  writer.varint(to.before.pictures);
  writer.varint(to.before.time);
  writer.varint(to.passed);
  writer.u8(to.aside ? 1 : 0);
  return payload;
}

Result<Return> decode_return(std::span<const std::uint8_t> payload) {
  ByteReader reader(payload);
  const std::uint64_t scene = reader.varint();
  const StreamPosition before{reader.varint(), reader.varint()};
  const std::uint64_t passed = reader.varint();
  const std::uint8_t aside = reader.u8();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "a return ends early");
  if (before.pictures > kMaxStreamPictures || before.time > kMaxStreamTime || passed > kMaxPictureNumber)
    return fail(ErrorCode::kTooLarge, "too many pictures before a return");
  if (reader.malformed() || scene > kMaxCheck || aside > 1 || !can_last(before.pictures, before.time))
    return fail(ErrorCode::kInvalidStream, "a return is damaged");
  return Return{static_cast<std::uint32_t>(scene), before, aside != 0, static_cast<std::uint32_t>(passed)};
}

}  // namespace fbs
