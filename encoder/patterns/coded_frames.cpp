#include "encoder/patterns/coded_frames.h"

#include "decoder/pattern/obu.h"

namespace fbs {
namespace {

constexpr unsigned kSizeBit = 0x02, kShowExistingFrame = 0x80;

using Bytes = std::vector<std::uint8_t>;

void put_header(ObuType type, unsigned flags, Bytes& out) {
  out.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(type) << 3 | flags));
}

void put_leb128(std::size_t value, Bytes& out) {
  for (; value > 0x7F; value >>= 7) out.push_back(static_cast<std::uint8_t>(0x80 | (value & 0x7F)));
  out.push_back(static_cast<std::uint8_t>(value));
}

void put_bytes(std::span<const std::uint8_t> bytes, Bytes& out) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

tl::unexpected<Error> unexpected_unit() {
  return fail(ErrorCode::kInternal, "libaom writes an AV1 unit that is not expected");
}

}  // namespace

Result<std::vector<Bytes>> coded_frames(std::span<const std::uint8_t> temporal_unit) {
  std::vector<Bytes> frames;
  Bytes next;  // with a sequence header, until its frame follows
  for (ObuReader reader(temporal_unit); !reader.done();) {
    const auto obu = reader.next();
    if (!obu || obu->has_extension) return unexpected_unit();
    switch (obu->type) {
      case ObuType::kSequenceHeader:
        put_header(obu->type, kSizeBit, next);
        put_leb128(obu->payload.size(), next);
        put_bytes(obu->payload, next);
        break;
      case ObuType::kFrame:
        put_header(obu->type, 0, next);
        put_bytes(obu->payload, next);
        frames.push_back(std::exchange(next, {}));
        break;
      case ObuType::kFrameHeader:
        if (obu->payload.empty() || (obu->payload[0] & kShowExistingFrame) == 0) return unexpected_unit();
        break;
      case ObuType::kTemporalDelimiter:
      case ObuType::kMetadata:
      case ObuType::kPadding:
        break;
      default:
        return unexpected_unit();
    }
  }
  return frames;
}

}  // namespace fbs
