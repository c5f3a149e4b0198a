// The stream mutator as libFuzzer calls it; targets of whole streams link it. Payloads are changed by
// libFuzzer's own mutations, which know the constants that the code compares with.
#include <algorithm>

#include "tests/fuzz/replay.h"
#include "tests/fuzz/stream_mutator.h"

namespace {

using fbs::fuzz::Bytes;
using fbs::fuzz::Random;

void mutate_by_engine(Bytes& bytes, Random& /*random*/) {
  const std::size_t size = bytes.size(), room = size + 16;
  bytes.resize(room);
  bytes.resize(LLVMFuzzerMutate(bytes.data(), size, room));
}

std::size_t copy_out(const Bytes& bytes, std::uint8_t* out, std::size_t room) {
  const std::size_t size = std::min(bytes.size(), room);
  std::copy_n(bytes.begin(), size, out);
  return size;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t room,
                                               unsigned seed) {
  Random random(seed);
  const std::span<const std::uint8_t> stream(data, size);
  return copy_out(fbs::fuzz::mutate_stream(stream, stream, random, mutate_by_engine), data, room);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* one, std::size_t size_of_one,
                                                 const std::uint8_t* other, std::size_t size_of_other,
                                                 std::uint8_t* out, std::size_t room, unsigned seed) {
  Random random(seed);
  const Bytes mixed =
      fbs::fuzz::mutate_stream({one, size_of_one}, {other, size_of_other}, random, mutate_by_engine);
  return copy_out(mixed, out, room);
}
