// Bytes to pictures, a bounded number of them held.
#include "tests/fuzz/bounded_decode.h"
#include "tests/fuzz/fuzz_target.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return {stream};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fbs::fuzz::decode_bounded({data, size});
  return 0;
}
