#include "decoder/sound/sound_parts.h"

#include <utility>

#include "bitstream/payload/sound_payload.h"
#include "bitstream/sound_time.h"

namespace fbs {

void SoundParts::add(std::span<const std::uint8_t> bytes) {
  packets_.feed(bytes);
  for (;;) {
    const auto read = packets_.next();
    if (!read) {
      reader_.lose();
      if (pictures_) pictures_->lose();
      continue;
    }
    if (read->status != ReadStatus::kPacket) return;
    if (pictures_)
      if (const auto timed = pictures_->take(read->packet))
        if (const auto* const head = std::get_if<JoinedHead>(&timed->syntax))
          packets_.read_head(head->packets);
    take(read->packet);
  }
}

void SoundParts::take(const Packet& packet) {
  if (packet.type != PacketType::kSetup && !is_sound(packet.type)) return;
  if (is_sound(packet.type)) bytes_ += packet.size;
  auto syntax = reader_.read(packet);
  if (!syntax) return;
  if (auto* const group = std::get_if<SoundGroup>(&*syntax))
    parts_.push_back({*reader_.sound_setup(), std::move(*group)});
}

std::int64_t begin_of(const SoundPart& part) {
  return frame_time(part.setup, part.group.first);
}

std::int64_t end_of(const SoundPart& part) {
  return begin_of(part) + static_cast<std::int64_t>(part.group.frames.size()) * part.setup.duration;
}

}  // namespace fbs
