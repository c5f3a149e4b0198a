#include "decoder/stream/packet_list.h"

#include <array>

#include "bitstream/packet.h"
#include "decoder/stream/packet_times.h"

namespace fbs {
namespace {

constexpr auto kNames = std::to_array<const char*>({"", "setup", "geometry", "surround", "pattern", "motion",
                                                    "end", "blend", "wire-frame", "sound setup", "sound",
                                                    "unit", "head part", "return"});  // by PacketType

std::string name_of(PacketType type) {
  const auto number = static_cast<std::size_t>(type);
  return number > 0 && number < kNames.size() ? kNames[number] : "type " + std::to_string(number);
}

PacketEntry entry_of(const Packet& packet, PacketTimes& times, PacketReader& reader) {
  PacketEntry entry{packet.offset, packet.size, name_of(packet.type), false,
                    std::nullopt,  {},          packet.repaired};
  const bool lost = times.has_losses();
  const auto timed = times.take(packet);
  if (!timed) {
    entry.error = timed.error().text;
    return entry;
  }
  if (const auto* const head = std::get_if<JoinedHead>(&timed->syntax)) reader.read_head(head->packets);
  entry.key = timed->key;
  entry.time = timed->time;
  if (timed->missing > 0 && !lost)  // otherwise the loss has been reported
    entry.error = std::to_string(timed->missing) +
                  (timed->missing == 1 ? " picture is missing" : " pictures are missing");
  return entry;
}

}  // namespace

std::vector<PacketEntry> list_packets(std::span<const std::uint8_t> stream) {
  PacketReader reader(stream);
  PacketTimes times;
  std::vector<PacketEntry> entries;
  std::optional<Error> damage;
  for (;;) {
    const auto read = reader.next();
    if (!read) {
      damage = read.error();
      times.lose();
      continue;
    }
    if (read->packet.in_parts) {
      (void)times.take(read->packet);
      continue;
    }
    const bool end = read->status != ReadStatus::kPacket;
    if (damage) {
      const std::uint64_t next = end ? stream.size() : read->packet.offset;
      entries.push_back(
          {damage->byte_offset, next - damage->byte_offset, kDamage, false, std::nullopt, damage->text});
      damage.reset();
    }
    if (end) return entries;
    entries.push_back(entry_of(read->packet, times, reader));
  }
}

}  // namespace fbs
