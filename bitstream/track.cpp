#include "bitstream/track.h"

#include <algorithm>
#include <iterator>

namespace fbs {

std::int32_t interpolate(std::int64_t from, std::int64_t to, std::int64_t elapsed, std::int64_t length) {
  const std::int64_t twice = 2 * (to - from) * elapsed + length;
  const std::int64_t quotient = twice / (2 * length);
  const bool below = twice % (2 * length) < 0;
  return static_cast<std::int32_t>(from + quotient - (below ? 1 : 0));
}

Knot anchor_knot(const CodedState& anchor, std::size_t part) {
  Knot knot{.picture = -1, .value = {}};
  std::copy_n(anchor.begin() + kPartFirst[part], kPartSizes[part], knot.value.begin());
  return knot;
}

std::vector<State> states_of(const MotionGroup& group, const QuantiserSteps& steps) {
  // Motion goes on through the last of the missing pictures; before them the anchor is held.
  const std::int32_t bridged = std::min(group.missing, kMaxBridged);
  std::vector<CodedState> values(group.missing + group.pictures, CodedState{});
  for (std::size_t part = 0; part < kPartCount; ++part) {
    const auto first = kPartFirst[part];
    Knot last = anchor_knot(group.anchor, part);
    last.picture -= bridged;
    for (std::size_t i = 0; i < kPartSizes[part]; ++i)
      for (std::int32_t t = 0; t < group.missing - bridged; ++t)
        values[t][first + i] = last.value[i] * step_of(steps, first + i);
    for (const Knot& knot : group.tracks[part]) {
      const std::int32_t length = knot.picture - last.picture;
      for (std::size_t i = 0; i < kPartSizes[part]; ++i) {
        const std::int64_t step = step_of(steps, first + i);
        for (std::int32_t elapsed = 1; elapsed <= length; ++elapsed)
          values[group.missing + last.picture + elapsed][first + i] =
              interpolate(last.value[i] * step, knot.value[i] * step, elapsed, length);
      }
      last = knot;
    }
  }
  std::vector<State> states;
  states.reserve(values.size());
  std::transform(values.begin(), values.end(), std::back_inserter(states), state_of_values);
  return states;
}

std::vector<std::uint32_t> durations_of(const MotionGroup& group, const Rational& rate) {
  std::vector<std::uint32_t> out;
  const auto missing = static_cast<std::uint32_t>(group.missing);
  for (std::uint32_t k = 0; k < missing; ++k)  // they share their time evenly
    out.push_back(static_cast<std::uint32_t>(group.missing_time * std::uint64_t{k + 1} / missing -
                                             group.missing_time * std::uint64_t{k} / missing));
  out.insert(out.end(), group.durations.begin(), group.durations.end());
  if (group.durations.empty()) out.insert(out.end(), group.pictures, nominal_duration(rate));
  return out;
}

CodedState last_of(const MotionGroup& group) {
  CodedState last{};
  for (std::size_t part = 0; part < kPartCount; ++part)
    if (!group.tracks[part].empty())
      std::copy_n(group.tracks[part].back().value.begin(), kPartSizes[part], last.begin() + kPartFirst[part]);
  return last;
}

MotionGroup knots_everywhere(const CodedState& anchor, const std::vector<CodedState>& states,
                             PartMask parts) {
  MotionGroup group;
  group.anchor = anchor;
  group.pictures = static_cast<std::int32_t>(states.size());
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if (!has_part(parts, part)) continue;
    for (std::size_t t = 0; t < states.size(); ++t) {
      Knot knot{.picture = static_cast<std::int32_t>(t), .value = {}};
      std::copy_n(states[t].begin() + kPartFirst[part], kPartSizes[part], knot.value.begin());
      group.tracks[part].push_back(knot);
    }
  }
  return group;
}

}  // namespace fbs
