#include "decoder/sound/sound_parts.h"

#include <utility>

#include "bitstream/payload/sound_payload.h"
#include "bitstream/sound_time.h"

namespace fbs {

void SoundParts::add(std::span<const std::uint8_t> bytes) {
  reader_.feed(bytes);
  for (;;) {
    const auto read = damaged_ ? reader_.resync() : reader_.next();
    if (!read) {
      if (damaged_ || read.error().code == ErrorCode::kNotFbs) return;
      damaged_ = lost_ = true;
      if (lister_) lister_->lose();
      continue;
    }
    if (read->status != ReadStatus::kPacket) return;
    damaged_ = false;
    if (lister_) lister_->take(read->packet);
    take(read->packet);
  }
}

void SoundParts::take(const Packet& packet) {
  if (packet.type == PacketType::kSetup) {
    setup_.reset();
    lost_ = false;
  }
  if (lost_) return;
  if (packet.type == PacketType::kSoundSetup) {
    const auto setup = decode_sound_setup(packet.payload);
    setup_ = setup ? *setup : std::nullopt;
  }
  if (packet.type != PacketType::kSound || !setup_) return;
  auto group = decode_sound(packet.payload, *setup_);
  if (!group || group->first < next_) return;
  next_ = group->first + static_cast<std::int64_t>(group->frames.size());
  parts_.push_back({*setup_, std::move(*group)});
}

std::int64_t begin_of(const SoundPart& part) {
  return frame_time(part.setup, part.group.first);
}

std::int64_t end_of(const SoundPart& part) {
  return begin_of(part) + static_cast<std::int64_t>(part.group.frames.size()) * part.setup.duration;
}

}  // namespace fbs
