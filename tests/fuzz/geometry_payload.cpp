// Bytes to a head: all vertices are within their limits, and a head that was read can be written in steps of
// one and read back.
#include "bitstream/payload/geometry_payload.h"

#include <algorithm>
#include <cstdlib>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kGeometry);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto geometry = fbs::decode_geometry({data, size});
  if (!geometry) {
    require(geometry.error().code != fbs::ErrorCode::kInternal, "internal error");
    return 0;
  }
  for (const glm::ivec3& p : geometry->positions)
    require(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= fbs::kMaxCoordinate,
            "a vertex out of range");
  const auto coded = fbs::encode_geometry(*geometry, 1);
  require(coded.has_value(), "a head that was read cannot be written");
  require(
      coded->payload.size() > fbs::kMaxGeometryPayload || *fbs::decode_geometry(coded->payload) == *geometry,
      "round trip");
  return 0;
}
