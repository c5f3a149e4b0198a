#include "cli/stream/sound_interleaver.h"

#include <algorithm>
#include <utility>

#include "bitstream/payload/sound_payload.h"
#include "bitstream/sound_time.h"
#include "bitstream/syntax.h"

namespace fbs::cli {
namespace {

/// The frames of a group that one packet holds.
SoundGroup part_of(const SoundGroup& group, std::size_t begin, std::size_t most) {
  const std::size_t end = std::min(begin + most, group.frames.size());
  const auto frame = [&](std::size_t k) { return group.frames.begin() + static_cast<std::ptrdiff_t>(k); };
  return {group.first + static_cast<std::int64_t>(begin), {frame(begin), frame(end)}};
}

}  // namespace

Result<std::vector<std::uint8_t>> SoundInterleaver::add(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> out;
  if (!std::exchange(begun_, true)) write_signature(out);
  reader_.feed(bytes);
  for (;;) {
    const auto read = reader_.next();
    if (!read) return fail(read.error());
    if (read->status != ReadStatus::kPacket) return out;
    if (auto taken = take(read->packet, out); !taken) return fail(taken.error());
  }
}

Result<void> SoundInterleaver::take(const Packet& packet, std::vector<std::uint8_t>& out) {
  if (is_sound(packet.type)) return fail(ErrorCode::kInvalidArgument, "the stream has sound already");
  const std::uint64_t before = times_.released().time;
  (void)times_.take(packet);  // what is wrong is left to who decodes it
  const bool ends = packet.type == PacketType::kEnd;
  if (times_.released().time > before || ends)
    if (auto added = add_sound(sound_time(static_cast<std::int64_t>(times_.released().time)), out); !added)
      return added;
  writer_.write(out, packet.type, packet.payload);
  if (packet.type != PacketType::kSetup && packet.type != PacketType::kHeadPart) return {};
  const auto setup = encode_sound_setup(setup_);
  if (!setup) return fail(setup.error());
  writer_.write(out, PacketType::kSoundSetup, *setup);
  return {};
}

Result<void> SoundInterleaver::add_sound(std::int64_t before, std::vector<std::uint8_t>& out) {
  const auto groups = feed_(before);
  if (!groups) return fail(groups.error());
  const auto most = static_cast<std::size_t>(std::max(1, kMaxSoundGroup / setup_.duration));
  for (const SoundGroup& group : *groups) {
    for (std::size_t begin = 0; begin < group.frames.size(); begin += most) {
      const auto payload = encode_sound(part_of(group, begin, most), setup_);
      if (!payload) return fail(payload.error());
      writer_.write(out, PacketType::kSound, *payload);
    }
  }
  return {};
}

}  // namespace fbs::cli
