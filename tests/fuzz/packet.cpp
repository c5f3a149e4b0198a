// Bytes, in pieces of any size, to packets: every packet lies within the bytes fed, and the end is reached.
#include "bitstream/packet.h"

#include "tests/fuzz/fuzz_target.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return {stream};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  const std::size_t piece = size == 0 ? 1 : 1 + bytes.back() * std::size_t{7};
  fbs::PacketReader reader;
  std::uint64_t end_of_last = 0;
  for (std::size_t fed = 0, steps = 0;; ++steps) {
    require(steps < 4 * size + 16, "the reader does not come to an end");
    const auto read = reader.next();
    if (!read) {
      require(read.error().code != fbs::ErrorCode::kInternal, "internal error");
    } else if (read->status == fbs::ReadStatus::kEnd) {
      return 0;
    } else if (read->status == fbs::ReadStatus::kPacket) {
      require(read->packet.offset >= end_of_last, "packets overlap");
      end_of_last = read->packet.offset + read->packet.size;
      require(end_of_last <= fed, "a packet of bytes not yet fed");
    } else if (fed < size) {
      const std::size_t n = piece < size - fed ? piece : size - fed;
      reader.feed(bytes.subspan(fed, n));
      fed += n;
    } else {
      reader.close();
    }
  }
}
