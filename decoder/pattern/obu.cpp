#include "decoder/pattern/obu.h"

#include <cassert>

namespace fbs {
namespace {

constexpr int kMaxLeb128Bytes = 8;

constexpr unsigned kForbiddenBit = 0x80, kExtensionBit = 0x04, kSizeBit = 0x02;

}  // namespace

std::optional<std::uint8_t> ObuReader::byte() {
  if (left_.empty()) return std::nullopt;
  const std::uint8_t value = left_.front();
  left_ = left_.subspan(1);
  return value;
}

std::optional<std::uint64_t> ObuReader::leb128() {
  std::uint64_t value = 0;
  for (int i = 0; i < kMaxLeb128Bytes; ++i) {
    const auto next = byte();
    if (!next) return std::nullopt;
    value |= static_cast<std::uint64_t>(*next & 0x7FU) << (7 * i);
    if (*next < 0x80) return value;
  }
  return std::nullopt;
}

Result<Obu> ObuReader::next() {
  assert(!done());
  const unsigned header = *byte();
  if ((header & kForbiddenBit) != 0) return fail(ErrorCode::kInvalidStream, "not an AV1 unit");
  Obu obu;
  obu.type = static_cast<ObuType>(header >> 3);
  obu.has_extension = (header & kExtensionBit) != 0;
  if (obu.has_extension && !byte()) return fail(ErrorCode::kInvalidStream, "an AV1 unit is cut short");
  std::size_t size = left_.size();
  if ((header & kSizeBit) != 0) {
    const auto coded = leb128();
    if (!coded || *coded > left_.size())
      return fail(ErrorCode::kInvalidStream, "an AV1 unit is longer than its packet");
    size = static_cast<std::size_t>(*coded);
  }
  obu.payload = left_.first(size);
  left_ = left_.subspan(size);
  return obu;
}

}  // namespace fbs
