// Bytes to a return packet: what it says is within its limits and can be written and read back.
#include "bitstream/payload/return_payload.h"

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kReturn);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto to = fbs::decode_return({data, size});
  if (!to) {
    require(to.error().code != fbs::ErrorCode::kInternal, "internal error");
    return 0;
  }
  require(to->scene < 1U << 24 && fbs::can_last(to->before.pictures, to->before.time),
          "a number out of range");
  require(*fbs::decode_return(fbs::encode_return(*to)) == *to, "round trip");
  return 0;
}
