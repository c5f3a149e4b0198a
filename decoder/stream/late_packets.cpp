#include "decoder/stream/late_packets.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace fbs {
namespace {

/// More are not kept for one that is missing: half a dozen seconds of a call.
constexpr std::size_t kMaxKept = 32;

}  // namespace

void LatePackets::feed(std::uint64_t number, std::span<const std::uint8_t> bytes) {
  arrived_.push_back({number, {bytes.begin(), bytes.end()}});
}

std::optional<std::span<const std::uint8_t>> LatePackets::next(SceneReader& reader) {
  drop_complete(reader);
  // All that are there are put in order before one is read behind a gap.
  while (!arrived_.empty() && (position_ == kept_.size() || kept_.size() < kMaxKept)) {
    Received packet = std::move(arrived_.front());
    arrived_.pop_front();
    if (!before_ && packet.number == expected_.value_or(packet.number)) {
      expected_ = packet.number + 1;
      current_ = std::move(packet);
      return current_.bytes;
    }
    place(std::move(packet), reader);
  }
  if (position_ == kept_.size()) return std::nullopt;
  return kept_[position_++].bytes;
}

void LatePackets::place(Received packet, SceneReader& reader) {
  const bool late = packet.number < *expected_;
  if (late && (!before_ || packet.number < first_)) return;
  if (!before_) {
    before_ = reader;
    first_ = *expected_;
  }
  const auto at = std::lower_bound(kept_.begin(), kept_.end(), packet.number,
                                   [](const Received& r, std::uint64_t number) { return r.number < number; });
  if (at != kept_.end() && at->number == packet.number) return;
  expected_ = std::max(*expected_, packet.number + 1);
  kept_.insert(at, std::move(packet));
  const bool full = kept_.size() > kMaxKept;
  if (full) give_up(kept_.front().number);
  if (!late && !full) return;
  reader.go_back(*before_);
  position_ = 0;
}

void LatePackets::drop_complete(const SceneReader& reader) {
  if (position_ == 0) return;
  const auto end = kept_.begin() + static_cast<std::ptrdiff_t>(position_);
  const std::uint64_t behind = std::prev(end)->number + 1, from = std::max(first_, given_up_);
  const auto there = std::count_if(kept_.begin(), end, [&](const Received& r) { return r.number >= from; });
  if (behind > from && static_cast<std::uint64_t>(there) < behind - from) return;
  kept_.erase(kept_.begin(), end);
  position_ = 0;
  first_ = behind;
  if (kept_.empty())
    before_.reset();
  else
    before_ = reader;
}

void LatePackets::begin_scene() {
  if (position_ > 0) give_up(kept_[position_ - 1].number);
}

std::vector<std::uint64_t> LatePackets::missing(std::size_t most) const {
  std::vector<std::uint64_t> out;
  if (!before_) return out;
  auto next = kept_.begin();
  for (std::uint64_t n = std::max(first_, given_up_); n < *expected_ && out.size() < most; ++n) {
    while (next != kept_.end() && next->number < n) ++next;
    if (next == kept_.end() || next->number != n) out.push_back(n);
  }
  return out;
}

}  // namespace fbs
