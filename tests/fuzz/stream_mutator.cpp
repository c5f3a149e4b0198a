#include "tests/fuzz/stream_mutator.h"

#include <algorithm>
#include <utility>

#include "bitstream/byte_io.h"
#include "bitstream/packet.h"
#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "tests/fuzz/setup_fields.h"

namespace fbs::fuzz {
namespace {

constexpr std::size_t kMostPackets = 400;  // of a stream that grows by insertions

/// The packet that begins with the first of `bytes`; nothing if it is not whole.
struct Found {
  bool whole = false;
  std::uint8_t type = 0;
  std::span<const std::uint8_t> payload;
  std::size_t size = 0;  ///< with its check
};

Found find_packet(std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  Found out;
  out.type = reader.u8();
  const std::uint64_t size = reader.varint();
  if (size > kMaxPayload) return out;
  out.payload = reader.bytes(size);
  (void)reader.bytes(crc_of(size).bits() / 8);
  out.size = reader.offset();
  out.whole = reader.ok();
  return out;
}

std::size_t index(std::size_t size, Random& random) {
  return random() % size;
}

/// Any packet; size is not 0.
LoosePacket& any_of(std::vector<LoosePacket>& packets, Random& random) {
  return packets[index(packets.size(), random)];
}

void change_a_setup(std::vector<LoosePacket>& packets, Random& random) {
  std::vector<LoosePacket*> setups;
  for (LoosePacket& packet : packets)
    if (packet.type == static_cast<std::uint8_t>(PacketType::kSetup)) setups.push_back(&packet);
  if (setups.empty()) return;
  LoosePacket& setup = *setups[index(setups.size(), random)];
  SetupFields fields = read_setup_fields(setup.payload);
  change_setup(fields, random);
  setup.payload = write_setup_fields(fields);
}

/// Copies a run of packets to some place.
void insert_run(std::vector<LoosePacket>& packets, const std::vector<LoosePacket>& from, Random& random) {
  if (from.empty() || packets.size() > kMostPackets) return;
  const std::size_t begin = index(from.size(), random);
  const std::size_t count = 1 + index(std::min<std::size_t>(from.size() - begin, 8), random);
  const std::vector<LoosePacket> run(from.begin() + begin, from.begin() + begin + count);
  packets.insert(packets.begin() + index(packets.size() + 1, random), run.begin(), run.end());
}

/// Goes on with the end of another stream.
void go_on_with(std::vector<LoosePacket>& packets, const std::vector<LoosePacket>& other, Random& random) {
  if (other.empty()) return;
  packets.resize(index(packets.size() + 1, random));
  packets.insert(packets.end(), other.begin() + index(other.size(), random), other.end());
}

/// Changes the bytes of a payload, or its end.
void change_a_payload(std::vector<LoosePacket>& packets, Random& random, const MutateBytes& mutate) {
  Bytes& payload = any_of(packets, random).payload;
  if (random() % 8 == 0) {
    payload.resize(index(payload.size() + 4, random));
  } else {
    if (payload.empty()) payload.push_back(0);
    mutate(payload, random);
  }
}

/// Puts a return packet in some place, with the position of another setup packet if there is one.
void insert_return(std::vector<LoosePacket>& packets, Random& random) {
  Return to{0, {}, random() % 4 != 0};
  if (const auto setup = decode_setup(any_of(packets, random).payload)) to.before = setup->before;
  packets.insert(packets.begin() + index(packets.size() + 1, random),
                 {static_cast<std::uint8_t>(PacketType::kReturn), encode_return(to)});
}

/// Has most returns to scenes that are not there name others: checks depend on all that is before them.
void name_scenes(std::vector<LoosePacket>& packets, Random& random) {
  PacketWriter writer;
  std::vector<std::uint32_t> scenes;
  bool in_head = false;
  for (LoosePacket& packet : packets) {
    const auto type = static_cast<PacketType>(packet.type);
    if (type == PacketType::kReturn && !scenes.empty() && random() % 8 != 0)
      if (auto to = decode_return(packet.payload);
          to && std::ranges::find(scenes, to->scene) == scenes.end()) {
        to->scene = scenes[index(scenes.size(), random)];
        packet.payload = encode_return(*to);
      }
    Bytes written;
    const std::uint32_t check = writer.write(written, type, packet.payload);
    if (type == PacketType::kSetup) in_head = true;
    if (type == PacketType::kPattern && std::exchange(in_head, false)) scenes.push_back(check);
  }
}

/// Changes the length of a packet and nothing else.
void change_a_length(Bytes& stream, Random& random) {
  const auto borders = packet_borders(stream);
  if (borders.size() < 2) return;
  const std::size_t begin = borders[index(borders.size() - 1, random)];
  ByteReader reader(std::span<const std::uint8_t>(stream).subspan(begin + 1));
  const std::uint64_t size = reader.varint();
  Bytes length;
  const std::uint64_t changed =
      random() % 3 == 0 ? std::uint64_t{1} << random() % 64 : size + random() % 9 - 4;
  ByteWriter(length).varint(changed);
  if (random() % 8 == 0) length.back() |= 0x80;  // goes on in the payload
  const auto at = stream.begin() + static_cast<std::ptrdiff_t>(begin) + 1;
  stream.insert(stream.erase(at, at + static_cast<std::ptrdiff_t>(reader.offset())), length.begin(),
                length.end());
}

}  // namespace

LooseStream read_loose(std::span<const std::uint8_t> stream) {
  LooseStream out;
  const auto borders = packet_borders(stream);
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const Found packet = find_packet(stream.subspan(borders[i]));
    out.packets.push_back({packet.type, Bytes(packet.payload.begin(), packet.payload.end())});
  }
  const auto rest = stream.subspan(borders.back());
  out.rest.assign(rest.begin(), rest.end());
  return out;
}

Bytes write_loose(const LooseStream& stream) {
  Bytes out;
  write_signature(out);
  PacketWriter writer;
  for (const LoosePacket& packet : stream.packets)
    writer.write(out, static_cast<PacketType>(packet.type), packet.payload);
  out.insert(out.end(), stream.rest.begin(), stream.rest.end());
  return out;
}

std::vector<std::size_t> packet_borders(std::span<const std::uint8_t> stream) {
  std::vector<std::size_t> out = {std::min(kSignature.size(), stream.size())};
  for (;;) {
    const Found packet = find_packet(stream.subspan(out.back()));
    if (!packet.whole) return out;
    out.push_back(out.back() + packet.size);
  }
}

void repair_checks(Bytes& stream) {
  std::copy_n(kSignature.begin(), std::min(kSignature.size(), stream.size()), stream.begin());
  const LooseStream packets = read_loose(stream);
  if (stream.size() >= kSignature.size()) stream = write_loose(packets);
}

void change_packets(LooseStream& stream, const LooseStream& other, Random& random,
                    const MutateBytes& mutate) {
  auto& packets = stream.packets;
  if (packets.empty()) return insert_run(packets, other.packets, random);
  const std::size_t at = index(packets.size(), random);
  switch (random() % 13) {
    case 0:
      packets.erase(packets.begin() + at);
      break;
    case 1:
      insert_run(packets, packets, random);
      break;
    case 2:
      std::swap(packets[at], packets[std::min(at + 1, packets.size() - 1)]);
      break;
    case 3:
      std::swap(packets[at], any_of(packets, random));
      break;
    case 4:
      insert_run(packets, other.packets, random);
      break;
    case 5:
      go_on_with(packets, other.packets, random);
      break;
    case 6:
      packets[at].type = static_cast<std::uint8_t>(random() % 14);
      break;
    case 7:
    case 8:
      change_a_setup(packets, random);
      break;
    case 9:
      insert_return(packets, random);
      break;
    default:
      change_a_payload(packets, random, mutate);
      break;
  }
  name_scenes(packets, random);
}

Bytes mutate_stream(std::span<const std::uint8_t> stream, std::span<const std::uint8_t> other, Random& random,
                    const MutateBytes& mutate) {
  LooseStream loose = read_loose(stream);
  const LooseStream donor = read_loose(other);
  for (unsigned n = 1 + random() % 3; n > 0; --n) change_packets(loose, donor, random, mutate);
  if (random() % 4 != 0) loose.rest.clear();
  Bytes out = write_loose(loose);
  if (random() % 16 == 0) {
    change_a_length(out, random);
    if (random() % 2 == 0) repair_checks(out);
  }
  if (random() % 16 == 0) out.resize(index(out.size() + 1, random));
  if (random() % 8 == 0) mutate(out, random);  // leaves checks or signature wrong
  return out;
}

}  // namespace fbs::fuzz
