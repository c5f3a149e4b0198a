// Bytes to a setup: all numbers are within their limits, and a setup that was read can be written and read
// back.
#include "bitstream/payload/setup_payload.h"

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kSetup);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto setup = fbs::decode_setup({data, size});
  if (!setup) {
    require(setup.error().code != fbs::ErrorCode::kInternal, "internal error");
    require(setup.error().code != fbs::ErrorCode::kInvalidArgument, "a caller's error for a stream's");
    return 0;
  }
  require(fbs::check_setup(*setup).has_value(), "a number out of range");
  const auto written = fbs::encode_setup(*setup);
  require(written.has_value(), "a setup that was read cannot be written");
  require(*fbs::decode_setup(*written) == *setup, "round trip");
  return 0;
}
