// Bytes to AV1 frames of one scene: width and height, each 64 and a byte, then frames of two bytes of length,
// high byte first, and as many bytes. Decoded frames have the requested size, whatever came before.
#include "decoder/pattern/pattern_decoder.h"

#include <algorithm>

#include "bitstream/byte_io.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

namespace {

constexpr int kSmallest = fbs::kMinPictureSize, kMaxFrames = 32;

void check(const fbs::DecodedFrame& frame, int width, int height) {
  const fbs::Picture& p = frame.picture;
  require(p.width() == width && p.height() == height, "a frame of another size");
  for (const fbs::Plane* plane : {&p.u, &p.v})
    require(plane->width == (width + 1) / 2 && plane->height == (height + 1) / 2, "chroma of another size");
}

}  // namespace

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  std::vector<Bytes> out;
  for (const SceneFrames& scene : frames_of(stream)) {
    const int side = std::max(scene.width, scene.height);
    if (side > kSmallest + 0xFF) continue;
    Bytes& seed = out.emplace_back();
    ByteWriter writer(seed);
    writer.u8(static_cast<std::uint8_t>(scene.width - kSmallest));
    writer.u8(static_cast<std::uint8_t>(scene.height - kSmallest));
    for (const Bytes& frame : scene.frames) {
      writer.u16(static_cast<std::uint16_t>(frame.size()));
      writer.bytes(frame);
    }
  }
  return out;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fbs::ByteReader reader({data, size});
  const int width = kSmallest + reader.u8(), height = kSmallest + reader.u8();
  auto decoder = fbs::PatternDecoder::create(width, height);
  require(decoder.has_value(), "no decoder");
  for (int frames = 0; frames < kMaxFrames && reader.remaining() > 0; ++frames) {
    const std::size_t length = reader.u16();
    const auto frame = decoder->decode_frame(reader.bytes(std::min(length, reader.remaining())));
    if (frame)
      check(*frame, width, height);
    else
      require(frame.error().code != fbs::ErrorCode::kInternal, "internal error");
  }
  return 0;
}
