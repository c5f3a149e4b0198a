// Bytes to pictures, of which a bounded number is held. The checks of packets are corrected first, since no
// engine guesses a CRC: so payloads are fuzzed too.
#include "decoder/stream_decoder.h"

#include <algorithm>
#include <span>
#include <vector>

#include "bitstream/byte_io.h"
#include "bitstream/crc16.h"
#include "tests/fuzz/fuzz_target.h"

const std::uint8_t kSeedPacket = 0;

namespace {

constexpr int kMaxSide = 160;  // pixels; small pictures find the same bugs sooner
constexpr std::size_t kMaxPictures = 60;

void correct_checks(std::vector<std::uint8_t>& bytes) {
  std::copy_n(fbs::kSignature.begin(), std::min(fbs::kSignature.size(), bytes.size()), bytes.begin());
  std::size_t begin = fbs::kSignature.size();
  std::uint16_t check = fbs::kCrc16Start;
  while (begin < bytes.size()) {
    fbs::ByteReader reader(std::span<const std::uint8_t>(bytes).subspan(begin));
    const auto type = static_cast<fbs::PacketType>(reader.u8());
    const auto size = reader.varint();
    (void)reader.bytes(size);
    if (!reader.ok() || reader.remaining() < 2) return;
    const bool alone = type == fbs::PacketType::kSetup || type == fbs::PacketType::kEnd;
    check = fbs::crc16(std::span<const std::uint8_t>(bytes).subspan(begin, reader.offset()),
                       alone ? fbs::kCrc16Start : check);
    begin += reader.offset();
    bytes[begin++] = static_cast<std::uint8_t>(check >> 8);
    bytes[begin++] = static_cast<std::uint8_t>(check);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  correct_checks(bytes);
  fbs::StreamDecoder decoder;
  decoder.feed(bytes);
  decoder.close();
  fbs::Picture picture, again;
  std::size_t in_a_row = 0;  // held pictures
  for (std::size_t steps = 0, drawn = 0; drawn < kMaxPictures;) {
    require(steps < 300 * size + 16, "the decoder does not come to an end");
    const auto status = decoder.next();
    if (!status) {
      ++steps;
      require(status.error().code != fbs::ErrorCode::kInternal, "internal error");
      continue;
    }
    if (*status == fbs::DecodeStatus::kEnd) break;
    require(*status == fbs::DecodeStatus::kPicture, "a closed stream asks for more");
    require(decoder.duration() >= 1 && decoder.duration() <= fbs::kMaxDuration, "a duration out of range");
    if (decoder.held()) {
      require(drawn > 0 && ++in_a_row <= fbs::kMaxHeldPictures, "too many pictures are held");
      if (in_a_row > 1) continue;
      require(decoder.render(again).has_value() && again == picture, "another picture than the last is held");
      continue;
    }
    ++steps;
    in_a_row = 0;
    if (std::max(decoder.format().width, decoder.format().height) > kMaxSide) break;
    require(decoder.render(picture).has_value(), "an announced picture is not drawn");
    ++drawn;
    require(picture.width() == decoder.format().width && picture.height() == decoder.format().height,
            "a picture of another size");
  }
  const fbs::ByteCount& b = decoder.bytes();
  require(b.geometry + b.patterns + b.motion + b.other == b.total, "bytes do not sum up");
  return 0;
}
