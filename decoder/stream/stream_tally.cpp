#include "decoder/stream/stream_tally.h"

#include <algorithm>
#include <functional>

#include "bitstream/byte_io.h"

namespace fbs {

namespace {

/// Bytes of a unit's payload before its blend.
std::size_t motion_bytes(std::span<const std::uint8_t> payload) {
  ByteReader reader(payload);
  const std::uint64_t size = reader.varint();
  return reader.offset() + static_cast<std::size_t>(size);
}

}  // namespace

StreamTally::StreamTally() {
  bytes_.other = bytes_.total = kSignature.size();
}

void StreamTally::count(const Packet& packet) {
  bytes_.other += packet.offset - bytes_.total;  // skipped bytes
  bytes_.total = packet.offset + packet.size;
  switch (packet.type) {
    case PacketType::kWireFrame:
    case PacketType::kGeometry:
    case PacketType::kSurround:
      bytes_.geometry += packet.size;
      break;
    case PacketType::kPattern:
      bytes_.patterns += packet.size;
      break;
    case PacketType::kMotion:
      bytes_.motion += packet.size;
      break;
    case PacketType::kBlend:
      bytes_.motion += packet.size;
      bytes_.blend += packet.size;
      break;
    case PacketType::kUnit:
      bytes_.motion += packet.size;
      bytes_.blend += packet.payload.size() - std::min(packet.payload.size(), motion_bytes(packet.payload));
      break;
    case PacketType::kSoundSetup:
    case PacketType::kSound:
      bytes_.sound += packet.size;
      break;
    default:
      bytes_.other += packet.size;
      break;
  }
}

void StreamTally::note_startup() {
  if (bytes_.startup == 0) bytes_.startup = bytes_.total;
}

void StreamTally::add(const Packet& packet, const SceneReader& reader, std::span<const ScenePattern> patterns,
                      const std::vector<bool>& reduced) {
  if (counts_motion_bits_ && patterns.front().is_first()) {
    std::erase_if(bit_counters_, [&](const auto& scene) { return !reader.knows(scene.first); });
    bit_counters_.emplace(reader.scene(), MotionBitCounter(reader.setup(), patterns.front().coded.state));
  }
  if (!records_patterns_) return;
  std::uint64_t frames = 0, frames_before = 0;
  for (const ScenePattern& pattern : patterns) frames += pattern.coded.av1.size();
  const auto share = [&](std::uint64_t bytes) { return packet.size * bytes / frames; };
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    const PatternSyntax& pattern = patterns[k].coded;
    const std::uint64_t frames_after = frames_before + pattern.av1.size();
    const Timeline::Entry* const known = reader.pictures().find(pattern.picture);
    patterns_.push_back({pattern.slot, known ? known->position.pictures : reader.setup().before.pictures,
                         share(frames_after) - share(frames_before), reduced[k]});
    frames_before = frames_after;
  }
}

void StreamTally::add(const MotionGroup& group, const SceneReader& reader) {
  const auto counter = bit_counters_.find(reader.scene());
  if (counter == bit_counters_.end()) return;
  const PartBitsX256 bits = counter->second.count(group);
  std::transform(bits.begin(), bits.end(), motion_bits_.begin(), motion_bits_.begin(), std::plus<>());
}

}  // namespace fbs
