// Bytes to a surround: all values are weights, and a surround that was read can be written and read back.
#include "bitstream/payload/surround_payload.h"

#include <algorithm>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kSurround);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto map = fbs::decode_surround({data, size});
  if (!map) {
    require(map.error().code != fbs::ErrorCode::kInternal, "internal error");
    return 0;
  }
  require(std::min(map->columns, map->rows) >= 1, "no cells");
  require(std::max(map->columns, map->rows) <= fbs::kMaxSurroundCells, "too many cells");
  const auto written = fbs::encode_surround(*map);
  require(written.has_value(), "a surround that was read cannot be written");
  require(*fbs::decode_surround(*written) == *map, "round trip");
  return 0;
}
