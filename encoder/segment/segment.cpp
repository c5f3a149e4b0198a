#include "encoder/segment/segment.h"

#include <algorithm>

#include "bitstream/pattern/pattern_packet.h"

namespace fbs {

std::int32_t pattern_store(const VideoFormat& format) {
  constexpr double kStoreBytes = 256e6;
  const double bytes = 1.5 * format.width * format.height;
  return static_cast<std::int32_t>(std::clamp(kStoreBytes / bytes, 4.0, double{kMaxPatterns}));
}

bool Segment::is_cut(std::size_t picture) const {
  std::size_t first = 0;
  return std::ranges::any_of(shots, [&](const Shot& shot) {
    const bool here = first == picture && first > 0;
    first += shot.pictures;
    return here;
  });
}

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
  std::size_t end = 0, sent = std::min<std::size_t>(1, shown.size());
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

namespace {

/// End of the packet that begins with a pattern.
/// @param arrived  end of the patterns that may share it
std::size_t packet_end(std::size_t begin, std::size_t arrived, std::span<const std::size_t> bytes) {
  std::size_t end = begin, sum = 0;
  do {
    sum += bytes[end++];
  } while (end < arrived && end - begin < kMaxPatterns && sum + bytes[end] <= kMaxPatternsTogether);
  return end;
}

}  // namespace

std::vector<PlannedPacket> in_stream_order(const Segment& segment, std::span<const std::size_t> shown,
                                           std::span<const std::size_t> arrived,
                                           std::span<const std::size_t> bytes) {
  std::vector<PlannedPacket> out;
  std::size_t pattern = 0, motion = 0, moved = 0, drawn = 0;
  const auto add_motion_until = [&](std::size_t picture) {
    for (; moved <= picture && motion < segment.groups.size(); ++motion) {
      moved += segment.groups[motion].pictures;
      out.push_back({PacketType::kMotion, motion, 1});
    }
  };
  for (std::size_t g = 0; g < segment.groups.size(); ++g) {
    while (pattern < arrived[g]) {
      const bool has_own_state = segment.states[shown[pattern]].picture == 0;
      const std::size_t end = has_own_state ? pattern + 1 : packet_end(pattern, arrived[g], bytes);
      if (!has_own_state) add_motion_until(*std::max_element(shown.begin() + pattern, shown.begin() + end));
      out.push_back({PacketType::kPattern, pattern, end - pattern});
      pattern = end;
    }
    drawn += segment.groups[g].pictures;
    add_motion_until(drawn - 1);
    out.push_back({PacketType::kBlend, g, 1});
  }
  return out;
}

}  // namespace fbs
