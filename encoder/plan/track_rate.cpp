#include "encoder/plan/track_rate.h"

#include <algorithm>
#include <cmath>

#include "bitstream/track.h"

namespace fbs {
namespace {

constexpr double kMemory = 0.85;     // weight of counts one group later; lower follows changes faster
constexpr double kPriorWeight = 6;   // observations that the priors below are worth
constexpr double kLengthBits = 2.5;  // for a span's length when it does not reach the group's end
constexpr double kPriorMoves = 0.5;  // probability that a part moves over a span
constexpr double kPriorToEnd = 0.3;  // probability that a span reaches the group's end
// Probability that a number changes when its part moves: falls along an expression part, whose coefficients
// are sorted by variance.
constexpr double kPriorChange = 0.5, kPriorChangeFall = 0.88;
constexpr double kPriorSize = 2.0;  // mean magnitude of a change, steps

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
                                ? kPriorChange
                                : kPriorChange * std::pow(kPriorChangeFall, place);
    const double changes = (changed_[i] + kPriorWeight * expected) / (seen_[i] + kPriorWeight);
    zero_[i] = bits_of(1 - changes);
    // Magnitudes as a geometric distribution with their mean.
    const double size =
        (size_[i] + kPriorWeight * expected * kPriorSize) / (changed_[i] + kPriorWeight * expected);
    const double stop = 1 / std::max(size, 1.05);
    not_zero_[i] = bits_of(changes) + 1 + bits_of(stop);
    more_[i] = bits_of(1 - stop);
  }
  for (std::size_t p = 0; p < kPartCount; ++p) {
    const double moves = (moved_[p] + kPriorMoves * kPriorWeight) / (spans_[p] + kPriorWeight);
    const double ends = (ended_[p] + kPriorToEnd * kPriorWeight) / (spans_[p] + kPriorWeight);
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
