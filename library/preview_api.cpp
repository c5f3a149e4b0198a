// The first picture of a stream before its decoder has come, for web/src/preview.js alone: the AV1 frame of
// the first pattern, which the browser decodes, and what is done to it then. The head is the generic one:
// that of the scene would take Draco, and half as many bytes again.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/byte_io.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"
#include "decoder/pattern/contrast_map.h"
#include "decoder/pattern/obu.h"
#include "decoder/pattern/pattern_decoder.h"
#include "decoder/pattern/upscale.h"
#include "fbs/fbs.h"
#include "library/caller_picture.h"

namespace {

using namespace fbs;

/// What web/src/preview.js reads; all zero where there is no frame.
struct Found {
  const std::uint8_t* av1;
  std::size_t size;  ///< bytes of av1
  fbs_format format;
};

PacketReader packets;
Setup setup;
bool has_face = false;
PatternSyntax pattern;
Found found{};

/// The frame with the size of each unit: browsers take no other.
std::vector<std::uint8_t> sized(std::span<const std::uint8_t> frame) {
  constexpr unsigned kHasSize = 2;
  std::vector<std::uint8_t> out;
  ByteWriter writer(out);
  for (ObuReader reader(frame); !reader.done();) {
    const auto obu = reader.next();
    if (!obu) return {};
    writer.u8(static_cast<std::uint8_t>(static_cast<unsigned>(obu->type) << 3 | kHasSize));
    writer.varint(obu->payload.size());
    writer.bytes(obu->payload);
  }
  return out;
}

}  // namespace

extern "C" {

/// Takes the next bytes of the stream.
/// @return null until the frame has come, or none can be had
const Found* preview_feed(const std::uint8_t* bytes, std::size_t size) {
  packets.feed({bytes, size});
  for (;;) {
    const auto read = packets.next();
    if (!read) return &found;
    if (read->status != ReadStatus::kPacket) return nullptr;
    const Packet& packet = read->packet;
    has_face = has_face || packet.type == PacketType::kGeometry;
    if (packet.type == PacketType::kSetup) {
      const auto decoded = decode_setup(packet.payload);
      if (!decoded) return &found;
      setup = *decoded;
    }
    if (packet.type == PacketType::kPattern) {
      const auto decoded = PatternPacketReader().decode(packet.payload, setup, 0);
      if (!decoded) return &found;
      pattern = decoded->front();
      pattern.av1 = sized(pattern.av1);
      found = {pattern.av1.data(), pattern.av1.size(), caller_format(setup.format)};
      return &found;
    }
  }
}

/// Makes the first picture.
/// @param planes         as Picture of web/src/types.d.ts has them: those of the frame, then those of the
/// picture in their place
/// @param width, height  of the frame
/// @return whether it has the stream's size, or half of it
bool preview_draw(std::uint8_t* planes, int width, int height) {
  const VideoFormat& format = setup.format;
  const bool full = width == format.width && height == format.height;
  if (!full && (width != reduced_size(format.width) || height != reduced_size(format.height))) return false;
  Picture picture(width, height);
  const std::uint8_t* in = planes;
  for (Plane* plane : {&picture.y, &picture.u, &picture.v}) {
    std::copy_n(in, plane->samples.size(), plane->samples.begin());
    in += plane->samples.size();
  }
  if (!full) picture = upscaled(picture, format.width, format.height);
  if (has_face) {
    Geometry head;
    for (std::size_t v = 0; v < kVertexCount; ++v) head.positions[v] = generic_head().vertices[v].position;
    ContrastMap(setup, head, state_of(pattern.state, setup.steps)).expand(picture);
  }
  for (const Plane* plane : {&picture.y, &picture.u, &picture.v})
    planes = std::copy(plane->samples.begin(), plane->samples.end(), planes);
  return true;
}
}
