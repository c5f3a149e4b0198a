#include "bitstream/packet_search.h"

#include <algorithm>
#include <array>

#include "bitstream/byte_io.h"
#include "bitstream/crc16.h"
#include "bitstream/syntax.h"

namespace fbs {
namespace {

constexpr std::size_t kLookAhead = 5;  // bytes of type and longest length

bool is_known(std::uint8_t type) {
  return type >= static_cast<std::uint8_t>(PacketType::kSetup) &&
         type <= static_cast<std::uint8_t>(PacketType::kBlend);
}

}  // namespace

void PacketSearch::add_candidate(std::span<const std::uint8_t> stream) {
  if (!is_known(stream[position_])) return;
  ByteReader reader(stream.subspan(position_, std::min(kLookAhead, stream.size() - position_)));
  [[maybe_unused]] const std::uint8_t type = reader.u8();
  const std::uint64_t size = reader.varint();
  if (!reader.ok() || size > kMaxSearchedPayload) return;
  candidates_.push_back({position_, position_ + reader.offset() + size, sum_});
  std::push_heap(candidates_.begin(), candidates_.end(), later);
}

std::optional<std::size_t> PacketSearch::find(std::span<const std::uint8_t> stream, bool closed) {
  const auto lacks = [&](std::size_t bytes) { return !closed && stream.size() - position_ < bytes; };
  while (position_ < stream.size()) {
    while (!candidates_.empty() && candidates_.front().end == position_) {
      if (lacks(sizeof(std::uint16_t))) return std::nullopt;
      const Candidate c = candidates_.front();
      std::pop_heap(candidates_.begin(), candidates_.end(), later);
      candidates_.pop_back();
      ByteReader check(stream.subspan(position_));
      const std::uint16_t stored = check.u16();
      const auto before = static_cast<std::uint16_t>(c.sum_before ^ kCrc16Start);
      const auto sum = static_cast<std::uint16_t>(sum_ ^ crc16_skip(before, c.end - c.begin));
      if (check.ok() && stored == sum) return c.begin;
    }
    if (lacks(kLookAhead)) return std::nullopt;
    add_candidate(stream);
    sum_ = crc16(stream.subspan(position_, 1), sum_);
    ++position_;
  }
  return std::nullopt;
}

std::size_t PacketSearch::first_open() const {
  std::size_t first = position_;
  for (const Candidate& c : candidates_) first = std::min(first, c.begin);
  return first;
}

void PacketSearch::drop_front(std::size_t count) {
  position_ -= count;
  for (Candidate& c : candidates_) {
    c.begin -= count;
    c.end -= count;
  }
}

}  // namespace fbs
