#include "encoder/segment.h"

#include <algorithm>

namespace fbs {

void Segment::move(std::size_t picture, const State& to) {
  const State before = std::exchange(states[picture], to);
  states[picture].picture = before.picture;
  states[picture].blend = before.blend;
}

std::vector<std::size_t> arrivals(const Segment& segment, std::span<const std::size_t> shown,
                                  bool first_alone) {
  const bool waits_for_one =
      first_alone && segment.groups.size() > 1;  // the last group brings all that is left
  std::vector<std::size_t> out;
  std::size_t end = 0, sent = 1;
  for (const Segment::Group& group : segment.groups) {
    end += group.pictures;
    if (!out.empty() || !waits_for_one) {
      std::size_t next = segment.states.size();
      for (const std::size_t picture : shown)
        if (picture + 1 >= end) next = std::min(next, picture);
      for (std::size_t k = sent; k < shown.size(); ++k)
        if (shown[k] <= next) sent = k + 1;
    }
    out.push_back(sent);
  }
  return out;
}

std::vector<TypedPayload> in_stream_order(Segment segment, std::span<const std::size_t> shown,
                                          std::span<const std::size_t> arrived,
                                          std::vector<std::vector<std::uint8_t>> patterns,
                                          std::vector<std::vector<std::uint8_t>> blends) {
  std::vector<TypedPayload> out;
  std::size_t next_pattern = 0, next_motion = 0, moved = 0, drawn = 0;
  const auto add_motion_until = [&](std::size_t picture) {
    for (; moved <= picture && next_motion < segment.groups.size(); ++next_motion) {
      moved += segment.groups[next_motion].pictures;
      out.emplace_back(PacketType::kMotion, std::move(segment.groups[next_motion].payload));
    }
  };
  for (std::size_t g = 0; g < segment.groups.size(); ++g) {
    for (; next_pattern < arrived[g]; ++next_pattern) {
      const bool has_own_state = segment.states[shown[next_pattern]].picture == 0;
      if (!has_own_state) add_motion_until(shown[next_pattern]);
      out.emplace_back(PacketType::kPattern, std::move(patterns[next_pattern]));
    }
    drawn += segment.groups[g].pictures;
    add_motion_until(drawn - 1);
    out.emplace_back(PacketType::kBlend, std::move(blends[g]));
  }
  return out;
}

}  // namespace fbs
