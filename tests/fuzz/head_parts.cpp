// Bytes to a part of a head: it is within its limits and can be written and read back. As many like it make a
// head, of which the same parts can be made.
#include "bitstream/scene/head_parts.h"

#include "bitstream/payload/head_part_payload.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kHeadPart);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto part = fbs::decode_head_part({data, size});
  if (!part) {
    require(part.error().code != fbs::ErrorCode::kInternal, "internal error");
    return 0;
  }
  require(part->size <= fbs::kMaxHead && part->symbols <= fbs::kMaxHeadSymbols, "a number out of range");
  require(*fbs::decode_head_part(fbs::encode_head_part(*part)) == *part, "round trip");

  fbs::HeadParts parts;
  std::optional<std::vector<std::uint8_t>> head;
  fbs::HeadPart next = *part;
  for (int k = 0; k < part->symbols; ++k) {
    require(!head, "a head of too few parts");
    next.index = (part->index + k) % fbs::kMaxHeadParts;
    if (!next.symbol.empty()) ++next.symbol.front();
    head = parts.add(next);
  }
  require(head && head->size() == part->size, "no head");
  const bool is_whole = part->size == part->symbol_size() * static_cast<std::size_t>(part->symbols);
  if (is_whole) require(fbs::head_symbol(*head, part->symbols, next.index) == next.symbol, "another symbol");
  return 0;
}
