#include "tests/fuzz/seeds.h"

#include <optional>

#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"

namespace fbs::fuzz {
namespace {

/// Calls `take` with each packet up to the first that is damaged or that it refuses.
template <class Take>
void for_each_packet(const Bytes& stream, Take&& take) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  for (auto read = reader.next(); read && read->status == ReadStatus::kPacket; read = reader.next())
    if (!take(read->packet)) return;
}

/// Reads the frames of a stream's patterns; motion too, since patterns name pictures.
class FrameReader {
 public:
  bool take(const Packet& packet) {
    switch (packet.type) {
      case PacketType::kSetup:
        return begin(packet);
      case PacketType::kPattern:
        return take_patterns(packet);
      case PacketType::kMotion:
        return take_motion(packet);
      default:
        return true;
    }
  }

  std::vector<SceneFrames> scenes;

 private:
  bool begin(const Packet& packet) {
    const auto setup = decode_setup(packet.payload);
    if (!setup) return false;
    setup_ = *setup;
    reader_ = {};
    motion_.reset();
    pictures_ = 0;
    return true;
  }

  bool take_patterns(const Packet& packet) {
    if (!setup_) return false;
    const auto patterns = reader_.decode(packet.payload, *setup_, pictures_);
    if (!patterns) return false;
    if (!motion_) {
      motion_.emplace(*setup_, patterns->front().state);
      scenes.push_back({setup_->format.width, setup_->format.height, {}});
    }
    for (const PatternSyntax& pattern : *patterns) scenes.back().frames.push_back(pattern.av1);
    return true;
  }

  bool take_motion(const Packet& packet) {
    if (!motion_) return false;
    const auto group = motion_->decode(packet.payload);
    if (group && *group) pictures_ += (*group)->pictures;
    return group.has_value();
  }

  std::optional<Setup> setup_;
  PatternPacketReader reader_;
  std::optional<MotionDecoder> motion_;
  std::int32_t pictures_ = 0;  // of the scene, that have a state
};

}  // namespace

std::vector<Bytes> payloads_of(const Bytes& stream, PacketType type) {
  std::vector<Bytes> out;
  for_each_packet(stream, [&](const Packet& packet) {
    if (packet.type == type) out.emplace_back(packet.payload.begin(), packet.payload.end());
    return true;
  });
  return out;
}

std::vector<SceneFrames> frames_of(const Bytes& stream) {
  FrameReader reader;
  for_each_packet(stream, [&](const Packet& packet) { return reader.take(packet); });
  return std::move(reader.scenes);
}

}  // namespace fbs::fuzz
