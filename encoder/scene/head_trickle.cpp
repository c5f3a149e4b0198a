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

/// s: so soon after a scene has begun so many heads are sent, for those who have lost its head. More than
/// one, since a lost packet of the link takes several parts.
constexpr double kSoon = 1.5, kSoonHeads = 1.5;

}  // namespace

HeadTrickle::HeadTrickle(double join) : join_(join) {
  packets_.feed(kSignature);
  (void)packets_.next();
}

void HeadTrickle::add(std::span<const std::uint8_t> packets) {
  const std::uint64_t begin = packets_.offset();
  packets_.feed(packets);
  for (;;) {
    const auto read = packets_.next();
    assert(read);
    if (read->status != ReadStatus::kPacket) break;
    const Packet& packet = read->packet;
    add(packet, packets.subspan(static_cast<std::size_t>(packet.offset - begin), packet.size));
    while (reader_.pictures().has_next()) (void)reader_.pictures().next();
  }
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
    surround_.assign(packet.payload.begin(), packet.payload.end());
  }
}

double HeadTrickle::heads() const {
  const double time = static_cast<double>(next_.passed.time) / kTicksPerSecond;
  const double soon = reader_.setup().before.pictures > 0 ? kSoonHeads * std::min(time / kSoon, 1.0) : 0;
  return soon + (join_ > 0 ? time / (kArrives * join_) : 0);
}

std::vector<TypedPayload> HeadTrickle::due() {
  std::vector<TypedPayload> out;
  const auto pictures = static_cast<std::uint64_t>(reader_.pictures().end());
  if (!complete_ || head_.size() > kMaxHead || pictures > kMaxPassedPictures) return out;
  const auto pieces = static_cast<int>((head_.size() + kSymbolBytes - 1) / kSymbolBytes);
  next_.size = head_.size();
  next_.symbols = std::clamp(pieces, kLeastSymbols, kMaxHeadSymbols);
  next_.passed = {pictures, reader_.pictures().end_time() - reader_.setup().before.time};
  for (const auto due = static_cast<int>(heads() * next_.symbols); sent_ < due; ++sent_) {
    next_.symbol = head_symbol(head_, next_.symbols, next_.index);
    out.emplace_back(PacketType::kHeadPart, encode_head_part(next_));
    next_.index = (next_.index + 1) % kMaxHeadParts;
    if (sent_ % (next_.symbols / 2) == 0 && !surround_.empty())
      out.emplace_back(PacketType::kSurround, surround_);
  }
  return out;
}

}  // namespace fbs
