#include "tests/fuzz/damaged_streams.h"

#include <algorithm>
#include <array>

namespace fbs::fuzz {
namespace {

enum class PacketDamage : std::uint8_t { kLeftOut, kRepeated, kSwapped };
constexpr auto kWords = std::to_array<const char*>({"left out", "repeated", "swapped with the next"});

}  // namespace

DamagedStreams::DamagedStreams(const Bytes& stream, const std::vector<Bytes>& others, std::size_t cut_step,
                               std::size_t mutations)
    : stream_(stream),
      others_(others),
      cut_step_(cut_step),
      mutations_(mutations),
      borders_(packet_borders(stream)) {}

Bytes DamagedStreams::with_damaged_packet(std::size_t packet, std::size_t damage) const {
  const auto at = [&](std::size_t border) {
    return stream_.begin() + static_cast<std::ptrdiff_t>(borders_[std::min(border, packets())]);
  };
  const auto begin = at(packet), end = at(packet + 1), end_of_next = at(packet + 2);
  Bytes out(stream_.begin(), begin);
  const auto add = [&](auto from, auto to) { out.insert(out.end(), from, to); };
  auto rest = end;
  switch (static_cast<PacketDamage>(damage / 2)) {
    case PacketDamage::kLeftOut:
      break;
    case PacketDamage::kRepeated:
      add(begin, end);
      add(begin, end);
      break;
    case PacketDamage::kSwapped:
      add(end, end_of_next);
      add(begin, end);
      rest = end_of_next;
      break;
  }
  add(rest, stream_.end());
  if (damage % 2 != 0) repair_checks(out);
  return out;
}

Bytes DamagedStreams::operator[](std::size_t number) const {
  if (number < cuts())
    return {stream_.begin(), stream_.begin() + static_cast<std::ptrdiff_t>(number * cut_step_)};
  number -= cuts();
  if (number < kPacketDamages * packets())
    return with_damaged_packet(number / kPacketDamages, number % kPacketDamages);
  Random random(static_cast<unsigned>(number));
  return mutate_stream(stream_, others_[random() % others_.size()], random);
}

std::string DamagedStreams::what(std::size_t number) const {
  if (number < cuts()) return "cut at byte " + std::to_string(number * cut_step_);
  number -= cuts();
  if (number >= kPacketDamages * packets())
    return "mutation " + std::to_string(number - kPacketDamages * packets());
  const std::size_t damage = number % kPacketDamages;
  return "packet " + std::to_string(number / kPacketDamages) + " " + kWords[damage / 2] +
         (damage % 2 != 0 ? ", checks repaired" : "");
}

}  // namespace fbs::fuzz
