// Bytes to the list of packets that `fbs inspect --packets` prints: its entries cover the stream, and it
// reports the same errors as the decoder.
#include "decoder/stream/packet_list.h"

#include <algorithm>

#include "bitstream/packet.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

bool decodes(std::span<const std::uint8_t> stream) {
  fbs::StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  for (;;) {
    const auto status = decoder.next();
    if (!status) return false;
    if (*status == fbs::DecodeStatus::kEnd) return true;
  }
}

}  // namespace

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return {stream};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> stream(data, size);
  const auto entries = fbs::list_packets(stream);
  bool right = true;
  const bool begins = size >= fbs::kSignature.size() &&
                      std::equal(fbs::kSignature.begin(), fbs::kSignature.end(), stream.begin());
  std::uint64_t end = begins ? fbs::kSignature.size() : 0;
  for (const auto& entry : entries) {
    require(entry.offset == end, "entries leave a gap or overlap");
    require(!entry.type.empty(), "an entry without a type");
    end += entry.bytes;
    right = right && entry.error.empty();
  }
  require(end == size, "entries do not cover the stream");
  require(right || !decodes(stream), "an error in a stream that decodes");
  return 0;
}
