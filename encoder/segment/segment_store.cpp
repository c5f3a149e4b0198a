#include "encoder/segment/segment_store.h"

#include <cassert>
#include <utility>

#include "bitstream/packet.h"
#include "decoder/pattern/contrast_map.h"
#include "encoder/plan/scene_timing.h"

namespace fbs {

SegmentStore::SegmentStore(const VideoFormat& format, const CodedState& rest, int groups_per_key)
    : format_(format), rest_(rest), groups_per_key_(groups_per_key), slots_(pattern_store(format)) {}

void SegmentStore::begin_scene(const CodedState& rest) {
  assert(segment_.states.empty());
  rest_ = rest;
  picture_ = 0;
  coders_ = {};
}

Result<void> SegmentStore::add(SharedPicture picture) {
  if (std::exchange(cut_, false) || segment_.shots.empty()) segment_.shots.push_back({});
  ++segment_.shots.back().pictures;
  return segment_.pictures.add(std::move(picture));
}

void SegmentStore::add(std::span<const State> states, std::vector<std::uint8_t> payload) {
  segment_.groups.push_back({states.size(), std::move(payload)});
  for (State s : states) {
    s.picture = number_of(segment_.states.size());
    segment_.states.push_back(s);
  }
}

void SegmentStore::end_group(std::span<const std::uint32_t> durations) {
  for (const std::uint32_t duration : durations) {
    if (duration == 0 || duration == nominal_duration(format_.frame_rate)) continue;
    ++timed_;
    ticks_ += duration;
  }
}

void SegmentStore::end_segment() {
  picture_ = number_of(segment_.states.size());
  segment_ = {};
  timed_ = 0;
  ticks_ = 0;
}

double SegmentStore::seconds() const {
  // Nominal durations are rounded to ticks; the frame rate is exact.
  const std::size_t regular = segment_.pictures.count() - timed_;
  return static_cast<double>(regular) / fps_of(format_) + static_cast<double>(ticks_) / kTicksPerSecond;
}

double SegmentStore::motion_bytes() const {
  double bytes = 0;
  for (const Segment::Group& group : segment_.groups) bytes += static_cast<double>(group.payload.size());
  return bytes;
}

const State& SegmentStore::seen_state(const Scene& scene, std::size_t time) const {
  return number_of(time) == 0 ? scene.patterns.front().seen : segment_.states[time];
}

void SegmentStore::reduce_contrast(const Scene& scene, std::size_t time, Picture& picture) const {
  if (ContrastMap::is_needed(scene.setup))
    ContrastMap(scene.setup, scene.geometry->geometry(), seen_state(scene, time)).reduce(picture);
}

PatternSyntax SegmentStore::pattern_syntax(std::size_t slot, std::size_t time,
                                           std::vector<std::uint8_t> av1) const {
  return {static_cast<std::int32_t>(slot), number_of(time), rest_, std::move(av1)};
}

void SegmentStore::set_modes(std::span<const RegionModes> modes) {
  for (std::size_t t = 0; t < modes.size(); ++t) segment_.states[t].blend = modes[t];
}

BlendGroup SegmentStore::blend_group(const BlendEncoder& encoder, std::size_t begin,
                                     std::size_t pictures) const {
  BlendGroup group;
  group.key = encoder.groups() % groups_per_key_ == 0;
  group.first = encoder.next();
  for (std::size_t t = begin; t < begin + pictures; ++t) group.modes.push_back(segment_.states[t].blend);
  return group;
}

std::size_t bytes_of(std::span<const TypedPayload> packets) {
  std::size_t bytes = 0;
  for (const auto& [type, payload] : packets) bytes += packet_size(payload.size());
  return bytes;
}

}  // namespace fbs
