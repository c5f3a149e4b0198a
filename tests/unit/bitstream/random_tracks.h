// Motion groups of random tracks, for tests and benchmarks of motion.
#pragma once

#include <algorithm>
#include <random>

#include "bitstream/syntax.h"

namespace fbs {

/// Statistics of random tracks.
struct TrackHabits {
  int knot_one_in = 6;   ///< one picture in this many has a knot
  int moves_one_in = 2;  ///< the part moves over one span in this many
  int reach = 3;         ///< largest change of a number over a span, within its limits
};

/// A group that begins at `anchor`; not key.
inline MotionGroup random_group(std::mt19937& random, const CodedLimits& limits, const CodedState& anchor,
                                std::int32_t pictures, const TrackHabits& habits) {
  const auto one_in = [&](int n) { return random() % static_cast<unsigned>(n) == 0; };
  MotionGroup group;
  group.anchor = anchor;
  group.pictures = pictures;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if (!has_part(limits.parts, part)) continue;
    Knot knot;
    std::copy_n(anchor.begin() + kPartFirst[part], kPartSizes[part], knot.value.begin());
    for (std::int32_t t = 0; t < pictures; ++t) {
      if (t + 1 < pictures && !one_in(habits.knot_one_in)) continue;
      knot.picture = t;
      const bool moves = one_in(habits.moves_one_in);
      for (std::size_t k = 0; moves && k < kPartSizes[part]; ++k) {
        if (one_in(2)) continue;
        const auto i = kPartFirst[part] + k;
        const int change =
            static_cast<int>(random() % static_cast<unsigned>(2 * habits.reach + 1)) - habits.reach;
        std::int32_t& value = knot.value[k];
        value = std::clamp(value + change, limits.min[i], limits.max[i]);
      }
      group.tracks[part].push_back(knot);
    }
  }
  return group;
}

}  // namespace fbs
