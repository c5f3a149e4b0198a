#include "encoder/scene/head_trickle.h"

#include <algorithm>
#include <cassert>

#include "bitstream/payload/head_part_payload.h"
#include "bitstream/scene/head_parts.h"

namespace fbs {
namespace {

/// Bytes of a symbol, where the head allows it: the rest of its packet has some 17.
constexpr std::size_t kSymbolBytes = 96;

/// Fewest symbols: with fewer, one that is lost delays a viewer by too much.
constexpr int kLeastSymbols = 12;

/// Share of the parts that arrive, of which a viewer joins in time.
constexpr double kArrives = 0.9;

/// s: so soon after a scene has begun its parts are sent once, for those who have lost its head.
constexpr double kSoon = 1.5;

/// How many of the parts that make a head have been sent by a time of the scene, s.
double heads_by(double time, double join) {
  return (std::min(time / kSoon, 1.0) + std::max(0.0, time - kSoon) / join) / kArrives;
}

}  // namespace

HeadTrickle::HeadTrickle(double seconds) : seconds_(seconds) {
  packets_.feed(kSignature);
  begin_ = kSignature.size();
}

void HeadTrickle::add(std::span<const std::uint8_t> packets) {
  packets_.feed(packets);
  for (;;) {
    const auto read = packets_.next();
    assert(read);
    if (read->status != ReadStatus::kPacket) break;
    const Packet& packet = read->packet;
    add(packet, packets.subspan(static_cast<std::size_t>(packet.offset - begin_), packet.size));
    while (reader_.pictures().has_next()) (void)reader_.pictures().next();
  }
  begin_ += packets.size();
}

void HeadTrickle::add(const Packet& packet, std::span<const std::uint8_t> whole) {
  const auto syntax = reader_.read(packet);
  assert(syntax);
  if (packet.type == PacketType::kSetup) {
    head_.clear();
    surround_.clear();
    complete_ = false;
    sent_ = 0;
  }
  if (!complete_) {
    head_.insert(head_.end(), whole.begin(), whole.end());
    complete_ = packet.type == PacketType::kPattern;
    next_.scene = static_cast<std::uint16_t>(packet.check);
  } else if (packet.type == PacketType::kSurround) {
    surround_.assign(whole.begin(), whole.end());
    ++next_.edition;
  }
}

std::vector<std::vector<std::uint8_t>> HeadTrickle::due() {
  std::vector<std::vector<std::uint8_t>> parts;
  next_.size = head_.size() + surround_.size();
  const auto pictures = static_cast<std::uint64_t>(reader_.pictures().end());
  if (!complete_ || next_.size > kMaxHead || pictures > kMaxPassedPictures) return parts;
  const auto pieces = static_cast<int>((next_.size + kSymbolBytes - 1) / kSymbolBytes);
  next_.symbols = std::clamp(pieces, kLeastSymbols, kMaxHeadSymbols);
  next_.passed = {pictures, reader_.pictures().end_time() - reader_.setup().before.time};
  const double time = static_cast<double>(next_.passed.time) / kTicksPerSecond;
  const double to_send = heads_by(time, seconds_) - sent_;
  std::vector<std::uint8_t> head = head_;
  head.insert(head.end(), surround_.begin(), surround_.end());
  for (int k = 1; k <= to_send * next_.symbols; ++k) {
    sent_ += 1.0 / next_.symbols;
    next_.symbol = head_symbol(head, next_.symbols, next_.index);
    parts.push_back(encode_head_part(next_));
    next_.index = (next_.index + 1) % kMaxHeadParts;
  }
  return parts;
}

}  // namespace fbs
