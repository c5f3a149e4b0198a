#include "decoder/stream/late_packets.h"

#include <cassert>
#include <iterator>
#include <limits>
#include <utility>

namespace fbs {
namespace {

/// More are not kept for one that is missing: half a dozen seconds of a call.
constexpr std::size_t kMaxKept = 32;

}  // namespace

bool LatePackets::Received::begins() const {
  const bool may_be_second = number > 1 && number <= kReorder;
  return !may_be_second && !bytes.empty() && static_cast<PacketType>(bytes.front()) == PacketType::kSetup;
}

void LatePackets::feed(std::uint64_t number, std::span<const std::uint8_t> bytes) {
  assert(number < std::numeric_limits<std::uint64_t>::max());
  arrived_.push_back({number, {bytes.begin(), bytes.end()}});
}

std::optional<std::span<const std::uint8_t>> LatePackets::next(SceneReader& reader) {
  drop_complete();
  // All that are there are put in order before one is read behind a gap.
  while (!arrived_.empty() && (!may_read() || kept_.size() < kMaxKept)) {
    place(std::move(arrived_.front()), reader);
    arrived_.pop_front();
  }
  find_start();
  const bool skips = std::exchange(skips_, false);
  if (position_ == kept_.size()) return std::nullopt;
  const Received& packet = kept_[position_];
  if (skips) skipped_ = std::max(skipped_, packet.number);
  if (!may_read()) return std::nullopt;
  behind_gap_ = packet.number > next_;
  if (behind_gap_) pass_gap(packet.number, reader);
  begun_ = true;
  next_ = packet.number + 1;
  ++position_;
  return packet.bytes;
}

bool LatePackets::skip() {
  skips_ = position_ < kept_.size() || !arrived_.empty();
  return skips_;
}

bool LatePackets::may_read() const {
  if (position_ == kept_.size()) return false;
  const Received& packet = kept_[position_];
  if (packet.number == next_ || packet.number <= std::max(given_up_, skipped_) || closed_) return true;
  return end_ - packet.number > kReorder || (next_ == 0 && packet.begins());
}

void LatePackets::find_start() {
  if (next_ > 0 || kept_.empty() || kept_.front().number == 0) return;
  auto start = std::find_if(kept_.begin(), kept_.end(), [](const Received& r) { return r.begins(); });
  if (start == kept_.end()) return;
  if (kept_.front().number <= given_up_) {  // no scene will begin among them
    give_up(start->number);
    start = kept_.erase(kept_.begin(), start);
  }
  position_ = static_cast<std::size_t>(start - kept_.begin());
}

void LatePackets::pass_gap(std::uint64_t number, SceneReader& reader) {
  if (!before_ && number > given_up_) {
    before_ = reader;
    first_ = next_;
    at_start_ = !begun_;
  }
  reader.note_losses();
}

void LatePackets::place(Received packet, SceneReader& reader) {
  const bool late = begun_ && packet.number < next_;
  if (late && (!before_ || packet.number < first_)) return;
  const auto at = std::lower_bound(kept_.begin(), kept_.end(), packet.number,
                                   [](const Received& r, std::uint64_t number) { return r.number < number; });
  if (at != kept_.end() && at->number == packet.number) return;
  end_ = std::max(end_, packet.number + 1);
  kept_.insert(at, std::move(packet));
  const bool full = before_ && kept_.size() > kMaxKept;
  if (full) give_up(kept_.front().number);
  if (!late && !full) return;
  reader.go_back(*before_);
  position_ = 0;
  next_ = first_;
}

void LatePackets::drop_complete() {
  const auto end = kept_.begin() + static_cast<std::ptrdiff_t>(position_);
  if (before_) {
    const std::uint64_t from = std::max(first_, given_up_);
    const auto there = std::count_if(kept_.begin(), end, [&](const Received& r) { return r.number >= from; });
    if (next_ > from && static_cast<std::uint64_t>(there) < next_ - from) return;
  }
  kept_.erase(kept_.begin(), end);
  position_ = 0;
  before_.reset();
  at_start_ = false;
}

void LatePackets::begin_scene() {
  if (!at_start_ && position_ > 0) give_up(kept_[position_ - 1].number);
}

void LatePackets::begin_pictures() {
  if (at_start_) give_up(next_);
}

std::uint64_t LatePackets::lowest_missing() const {
  if (begun_ && !at_start_) return std::max(before_ ? first_ : next_, given_up_);
  if (kept_.empty()) return end_;
  const Received& lowest = kept_.front();
  return std::max(lowest.begins() || lowest.number > kReorder ? lowest.number : 0, given_up_);
}

std::vector<std::uint64_t> LatePackets::missing(std::size_t most) const {
  std::vector<std::uint64_t> out;
  auto next = kept_.begin();
  for (std::uint64_t n = lowest_missing(); n < end_ && out.size() < most; ++n) {
    while (next != kept_.end() && next->number < n) ++next;
    const bool placed = next != kept_.end() && next->number == n;
    if (!placed &&
        std::none_of(arrived_.begin(), arrived_.end(), [n](const Received& r) { return r.number == n; }))
      out.push_back(n);
  }
  return out;
}

}  // namespace fbs
