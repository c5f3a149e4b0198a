#include "encoder/plan/track_rate.h"

#include <algorithm>
#include <cmath>

#include "bitstream/track.h"

namespace fbs {
namespace {

constexpr double kMemory = 0.85;     // what a group's counts still weigh a group later
constexpr double kBelief = 6;        // observations that the expectation before the first is worth
constexpr double kLengthBits = 2.5;  // of a span's length that is not to the end
// Of coefficients by place in their part; those of other parts are like the first.
constexpr double kChangesFirst = 0.5, kChangesFalls = 0.88;
constexpr double kSizeFirst = 2.0;

double bits_of(double probability) {
  return -std::log2(std::clamp(probability, 0.002, 0.998));
}

}  // namespace

double TrackRate::log2_of(int value) {
  return 2 * std::log2(static_cast<double>(value)) + 1;
}

TrackRate::TrackRate() {
  update();
}

void TrackRate::update() {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const std::size_t part = kPartOf[i];
    const auto place = static_cast<int>(i) - kPartFirst[part];
    const double expected = static_cast<int>(part) < kFirstExpressionPart
                                ? kChangesFirst
                                : kChangesFirst * std::pow(kChangesFalls, place);
    const double changes = (changed_[i] + kBelief * expected) / (seen_[i] + kBelief);
    zero_[i] = bits_of(1 - changes);
    // Magnitudes as a geometric distribution of their mean.
    const double size = (size_[i] + kBelief * expected * kSizeFirst) / (changed_[i] + kBelief * expected);
    const double stop = 1 / std::max(size, 1.05);
    not_zero_[i] = bits_of(changes) + 1 + bits_of(stop);
    more_[i] = bits_of(1 - stop);
  }
  for (std::size_t p = 0; p < kPartCount; ++p) {
    const double moves = (moved_[p] + 0.5 * kBelief) / (spans_[p] + kBelief);
    const double ends = (ended_[p] + 0.3 * kBelief) / (spans_[p] + kBelief);
    moves_[p] = bits_of(moves);
    holds_[p] = bits_of(1 - moves);
    to_end_[p] = bits_of(ends);
    not_to_end_[p] = bits_of(1 - ends) + kLengthBits;
  }
}

double TrackRate::knot(std::size_t part, const Knot& from, const Knot& to, std::int32_t pictures) const {
  const bool moves = to.value != from.value;
  double bits = span(part, moves, to.picture == pictures - 1);
  if (!moves) return bits;
  for (std::size_t k = 0; k < kPartSizes[part]; ++k)
    bits += change(kPartFirst[part] + k, to.value[k] - from.value[k]);
  return bits;
}

void TrackRate::learn(const MotionGroup& group) {
  for (auto* counts : {&seen_, &changed_, &size_})
    for (double& c : *counts) c *= kMemory;
  for (auto* counts : {&spans_, &moved_, &ended_})
    for (double& c : *counts) c *= kMemory;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    Knot last = anchor_knot(group.anchor, part);
    for (const Knot& knot : group.tracks[part]) {
      const bool moves = knot.value != last.value;
      spans_[part] += 1;
      moved_[part] += moves ? 1 : 0;
      ended_[part] += knot.picture == group.pictures - 1 ? 1 : 0;
      for (std::size_t k = 0; moves && k < kPartSizes[part]; ++k) {
        const std::size_t i = kPartFirst[part] + k;
        const int size = std::abs(knot.value[k] - last.value[k]);
        seen_[i] += 1;
        changed_[i] += size > 0 ? 1 : 0;
        size_[i] += size;
      }
      last = knot;
    }
  }
  update();
}

}  // namespace fbs
