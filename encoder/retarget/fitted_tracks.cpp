#include "encoder/retarget/fitted_tracks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bitstream/track.h"
#include "encoder/model/coded_numbers.h"

namespace fbs {
namespace {

/// Distance from the line that counts as rounding, steps: half for each end, and half as much again.
constexpr double kTolerance = 0.75;

class PartTrack {
 public:
  PartTrack(std::span<const StateNumbers> pictures, std::span<const CodedState> coded,
            const QuantiserSteps& steps, std::size_t part)
      : pictures_(pictures), coded_(coded), steps_(steps), part_(part) {}

  [[nodiscard]] Track from(Knot last) const {
    Track track;
    const auto end = static_cast<std::int32_t>(pictures_.size());
    while (last.picture < end - 1) {
      Knot next = knot(last.picture + 1);
      while (next.picture < end - 1) {
        const Knot farther = knot(next.picture + 1);
        if (!is_near(last, farther)) break;
        next = farther;
      }
      track.push_back(next);
      last = next;
    }
    return track;
  }

 private:
  [[nodiscard]] Knot knot(std::int32_t picture) const {
    Knot out{.picture = picture, .value = {}};
    std::copy_n(coded_[picture].begin() + kPartFirst[part_], kPartSizes[part_], out.value.begin());
    return out;
  }

  [[nodiscard]] bool is_near(const Knot& a, const Knot& b) const {
    const double length = b.picture - a.picture;
    for (std::size_t i = 0; i < kPartSizes[part_]; ++i) {
      const std::size_t number = kPartFirst[part_] + i;
      const double step = step_of(steps_, number);
      for (std::int32_t t = a.picture + 1; t < b.picture; ++t) {
        const double line = a.value[i] + (b.value[i] - a.value[i]) * (t - a.picture) / length;
        if (std::abs(line - pictures_[t][number] / step) > kTolerance) return false;
      }
    }
    return true;
  }

  std::span<const StateNumbers> pictures_;
  std::span<const CodedState> coded_;
  const QuantiserSteps& steps_;
  std::size_t part_;
};

}  // namespace

MotionGroup fitted_tracks(std::span<const StateNumbers> pictures, const CodedState& anchor,
                          const Setup& setup) {
  std::vector<CodedState> coded;
  coded.reserve(pictures.size());
  for (const StateNumbers& numbers : pictures) coded.push_back(coded_state(numbers, setup));
  MotionGroup group;
  group.anchor = anchor;
  group.pictures = static_cast<std::int32_t>(pictures.size());
  for (std::size_t part = 0; part < kPartCount; ++part)
    if (has_part(setup.parts, part))
      group.tracks[part] = PartTrack(pictures, coded, setup.steps, part).from(anchor_knot(anchor, part));
  return group;
}

}  // namespace fbs
