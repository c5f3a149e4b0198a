// Bytes to the end of a stream: the number is within its limit and can be written and read back.
#include "bitstream/payload/end_payload.h"

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kEnd);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto end = fbs::decode_end({data, size});
  if (!end) {
    require(end.error().code != fbs::ErrorCode::kInternal, "internal error");
    return 0;
  }
  require(end->pictures <= fbs::kMaxStreamPictures, "a number out of range");
  require(*fbs::decode_end(fbs::encode_end(*end)) == *end, "round trip");
  return 0;
}
