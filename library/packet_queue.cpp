#include "library/packet_queue.h"

#include "bitstream/byte_io.h"
#include "bitstream/payload/setup_payload.h"

namespace fbs {
namespace {

tl::unexpected<Error> not_ours() {
  return fail(ErrorCode::kInternal, "the encoder wrote a packet that cannot be read");
}

}  // namespace

Result<StreamPosition> PacketTimes::take(PacketType type, std::span<const std::uint8_t> payload) {
  if (type == PacketType::kSetup)
    if (auto begun = begin_scene(payload); !begun) return fail(begun.error());
  const StreamPosition moved = moved_, shown = shown_;
  Result<void> taken;
  if (type == PacketType::kPattern) taken = take_patterns(payload);
  if (type == PacketType::kMotion) taken = take_motion(payload);
  if (type == PacketType::kBlend) taken = take_blend(payload);
  if (!taken) return fail(taken.error());
  return type == PacketType::kMotion || type == PacketType::kEnd ? moved : shown;
}

Result<void> PacketTimes::begin_scene(std::span<const std::uint8_t> payload) {
  const auto setup = decode_setup(payload);
  if (!setup) return not_ours();
  setup_ = *setup;
  moved_ = shown_ = setup_.before;
  pictures_ = 0;
  waiting_.clear();
  patterns_ = {};
  motion_.reset();
  blend_ = {};
  return {};
}

Result<void> PacketTimes::take_patterns(std::span<const std::uint8_t> payload) {
  const auto patterns = patterns_.decode(payload, setup_, pictures_);
  if (!patterns || patterns->empty()) return not_ours();
  if (!motion_) motion_.emplace(setup_, patterns->front().state);
  return {};
}

Result<void> PacketTimes::take_motion(std::span<const std::uint8_t> payload) {
  if (!motion_) return not_ours();
  auto group = motion_->decode(payload);
  if (!group) return not_ours();
  if (group->durations.empty())
    group->durations.assign(static_cast<std::size_t>(group->pictures),
                            nominal_duration(setup_.format.frame_rate));
  for (const std::uint32_t duration : group->durations) {
    moved_.add(duration);
    ++pictures_;
    if (setup_.patterns > 1) waiting_.push_back(duration);
  }
  if (setup_.patterns == 1) shown_ = moved_;  // SPEC 6: pictures need no blend packet
  return {};
}

Result<void> PacketTimes::take_blend(std::span<const std::uint8_t> payload) {
  const auto group = blend_.decode(payload);
  if (!group || group->modes.size() > waiting_.size()) return not_ours();
  for (std::size_t k = 0; k < group->modes.size(); ++k) {
    shown_.add(waiting_.front());
    waiting_.pop_front();
  }
  return {};
}

void PacketQueue::add(std::span<const std::uint8_t> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<QueuedPacket>> PacketQueue::next() {
  const auto ahead = std::span(std::as_const(bytes_)).subspan(begin_);
  ByteReader reader(ahead);
  if (!signed_) (void)reader.bytes(kSignature.size());
  const auto type = static_cast<PacketType>(reader.u8());
  const auto payload = reader.bytes(reader.varint());
  (void)reader.u16();  // the check
  if (reader.malformed()) return not_ours();
  if (reader.past_end()) return std::nullopt;
  const auto first = times_.take(type, payload);
  if (!first) return fail(first.error());
  begin_ += reader.offset();
  signed_ = true;
  return QueuedPacket{ahead.first(reader.offset()), type == PacketType::kSetup, *first};
}

}  // namespace fbs
