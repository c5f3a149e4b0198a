// Bytes to patterns: slots and pictures are in range, frames no longer than the bytes can hold, and a packet
// that was read can be written and read back.
#include "bitstream/pattern/pattern_packet.h"

#include "bitstream/entropy/range_coder.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kPattern);
}

namespace {

constexpr std::int32_t kSlots = 8, kPictures = 40;
constexpr std::int32_t kMostAhead =
    2048;  // of a pattern that is alone: whether its picture has come is not asked

void check(const std::vector<fbs::PatternSyntax>& patterns, std::size_t bytes) {
  require(!patterns.empty() && patterns.size() <= fbs::kMaxPatterns, "a number of patterns");
  std::size_t left = bytes + fbs::kMaxVirtualBytes + patterns.size() * (fbs::kHeaderBytes + 1);
  for (const fbs::PatternSyntax& p : patterns) {
    require(p.slot >= 0 && p.slot < kSlots, "a slot out of range");
    if (p.alone)
      require(p.picture >= 1 && p.picture <= kPictures + kMostAhead, "a picture out of range");
    else
      require(p.picture >= 0 && p.picture < kPictures, "a picture without a state");
    require(!p.av1.empty() && p.av1.size() <= left, "frames of more bytes than there are");
    left -= p.av1.size();
  }
}

void decode(bool begun, std::span<const std::uint8_t> payload) {
  fbs::Setup setup;
  setup.format.width = setup.format.height = 64;
  setup.steps = {40, 16, 8, 16, 64};
  setup.patterns = kSlots;
  fbs::PatternPacketReader reader, again;
  fbs::PatternPacketWriter writer;
  if (begun) {
    fbs::PatternSyntax pattern;
    pattern.av1 = {0x0A, 0x0B, 0x00};
    const auto first = *writer.encode({&pattern, 1}, setup, 0);
    require(reader.decode(first, setup, 0) && again.decode(first, setup, 0), "a first pattern");
  }
  for (int packet = 0; packet < 2; ++packet) {  // the second is coded in the contexts of the first
    const auto read = reader.decode(payload, setup, kPictures);
    if (!read) {
      require(read.error().code != fbs::ErrorCode::kInternal, "internal error");
      return;
    }
    if (read->empty()) return;  // skipped
    check(*read, payload.size());
    if (read->front().picture >= kPictures) return;  // no writer sends it before its picture
    const auto written = writer.encode(*read, setup, kPictures);
    require(written.has_value(), "a packet that was read cannot be written");
    require(*again.decode(*written, setup, kPictures) == *read, "round trip");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const bool begun : {false, true}) decode(begun, {data, size});
  return 0;
}
