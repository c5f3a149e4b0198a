#include "decoder/stream/packet_times.h"

#include <utility>

#include "bitstream/sound_time.h"

namespace fbs {

void PacketTimes::lose() {
  reader_.lose();
  clock_.lose();
}

Result<TimedPacket> PacketTimes::take(const Packet& packet) {
  auto syntax = reader_.read(packet);
  TimedPacket out{{}, false, clock_.now(), clock_.now().time, 0};
  if (syntax) out.syntax = std::move(*syntax);
  const auto placed = syntax ? std::visit([&](const auto& s) { return place(s, out); }, out.syntax)
                             : Result<void>(fail(syntax.error()));
  if (!placed) {
    if (is_of_scene(packet.type) || (enters_scene(packet.type) && reader_.lost())) clock_.lose();
    return fail(placed.error().code, placed.error().text, packet.offset);
  }
  for (Timeline& pictures = reader_.pictures(); pictures.has_next();) clock_.show(pictures.next().duration);
  return out;
}

Result<void> PacketTimes::place(const Setup& setup, TimedPacket& out) {
  out.key = setup.keeps == SceneKeeping::kNone;
  auto jumped = jump(clock_.go_to(setup.before), out);
  if (!jumped) reader_.lose_scene();
  return jumped;
}

Result<void> PacketTimes::place(const Return& to, TimedPacket& out) {
  auto jumped = jump(clock_.go_to(to.before), out);
  if (!jumped) reader_.lose_scene();
  return jumped;
}

Result<void> PacketTimes::place(const End& end, TimedPacket& out) {
  const std::uint32_t nominal = reader_.has_setup() ? nominal_duration(reader_.setup().format.frame_rate) : 1;
  return jump(clock_.go_to_end(end.pictures, nominal), out);
}

Result<void> PacketTimes::jump(const Result<std::uint64_t>& missing, TimedPacket& out) {
  if (!missing) return fail(missing.error());
  out.missing = *missing;
  while (clock_.is_behind()) clock_.hold(nominal_duration(reader_.setup().format.frame_rate));
  out.first = clock_.now();
  out.time = out.first.time;
  return {};
}

Result<void> PacketTimes::place(const std::vector<ScenePattern>& patterns, TimedPacket& out) {
  out.key = patterns.front().is_first();
  if (!out.key) out.time = reader_.pictures().find(patterns.front().coded.picture)->position.time;
  return {};
}

Result<void> PacketTimes::place(const MotionGroup& group, TimedPacket& out) {
  out.key = group.key;
  const std::int32_t first = reader_.pictures().end() - group.pictures;
  out.missing = static_cast<std::uint64_t>(group.missing);
  if (group.missing > 0) clock_.lose();
  out.first = reader_.pictures().find(first)->position;
  out.time = out.first.time;
  return {};
}

Result<void> PacketTimes::place(const BlendGroup& group, TimedPacket& out) {
  out.key = group.key;
  out.missing = static_cast<std::uint64_t>(group.missing);
  return {};
}

Result<void> PacketTimes::place(const SoundGroup& group, TimedPacket& out) {
  const std::int64_t begin = frame_time(*reader_.sound_setup(), group.first);
  out.time = begin < 0 ? 0 : static_cast<std::uint64_t>(begin) * kTicksPerSecond / kSoundClock;
  return {};
}

Result<void> PacketTimes::place(std::monostate /*unused*/, TimedPacket& out) {
  out.time.reset();
  return {};
}

}  // namespace fbs
