#include "bitstream/scene/scene_reader.h"

#include <algorithm>
#include <utility>

#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "bitstream/track.h"

namespace fbs {
namespace {

tl::unexpected<Error> refuse(const char* text) {
  return fail(ErrorCode::kInvalidStream, text);
}

/// What a payload's reader returns, as the syntax of a packet.
template <class Syntax>
Result<SceneSyntax> as_syntax(Result<Syntax> read) {
  if (!read) return fail(read.error());
  return SceneSyntax(std::move(*read));
}

}  // namespace

bool is_of_scene(PacketType type) {
  switch (type) {
    case PacketType::kWireFrame:
    case PacketType::kGeometry:
    case PacketType::kSurround:
    case PacketType::kPattern:
    case PacketType::kMotion:
    case PacketType::kBlend:
      return true;
    default:
      return false;
  }
}

Result<SceneSyntax> SceneReader::read(const Packet& packet) {
  auto syntax = read_payload(packet);
  if (syntax) return syntax;
  if (is_of_scene(packet.type)) lose();
  Error error = std::move(syntax.error());
  error.byte_offset = packet.offset;
  return fail(std::move(error));
}

Result<SceneSyntax> SceneReader::read_payload(const Packet& packet) {
  if (packet.type == PacketType::kSetup) return read_setup(packet);
  if (packet.type == PacketType::kEnd) return as_syntax(decode_end(packet.payload));
  const bool known = is_of_scene(packet.type) || is_sound(packet.type);
  if (!known || lost_) return SceneSyntax{};  // SPEC 3.1, 6.2: skipped
  if (packet.type == PacketType::kSound) return read_sound(packet);
  if (!has_setup_) return refuse("a packet before the setup");
  switch (packet.type) {
    case PacketType::kWireFrame:
      return read_wire_frame(packet);
    case PacketType::kGeometry:
      return read_geometry(packet);
    case PacketType::kSurround:
      return as_syntax(decode_surround(packet.payload));
    case PacketType::kPattern:
      return read_patterns(packet);
    case PacketType::kMotion:
      return read_motion(packet);
    case PacketType::kBlend:
      return read_blend(packet);
    default:
      return read_sound_setup(packet);
  }
}

// SPEC 6.1
Result<SceneSyntax> SceneReader::read_setup(const Packet& packet) {
  lose();
  const auto setup = decode_setup(packet.payload);
  if (!setup) return fail(setup.error());
  const std::int64_t next_sound = next_sound_;
  *this = {};
  next_sound_ = next_sound;
  has_setup_ = true;
  setup_ = *setup;
  pictures_ = Timeline(setup_.before.time);
  return SceneSyntax(setup_);
}

Result<SceneSyntax> SceneReader::read_wire_frame(const Packet& packet) {
  auto frame = decode_wire_frame(packet.payload);
  if (!frame) return fail(frame.error());
  wire_frame_ = std::move(*frame);
  return motion_ ? SceneSyntax{} : SceneSyntax(wire_frame_);
}

Result<SceneSyntax> SceneReader::read_geometry(const Packet& packet) {
  auto geometry = decode_geometry(packet.payload, wire_frame_);
  if (!geometry) return fail(geometry.error());
  return motion_ ? SceneSyntax{} : SceneSyntax(std::move(*geometry));
}

Result<SceneSyntax> SceneReader::read_patterns(const Packet& packet) {
  auto read = patterns_.decode(packet.payload, setup_, pictures_.end());
  if (!read) return fail(read.error());
  std::vector<ScenePattern> patterns;
  for (PatternSyntax& pattern : *read) {
    auto placed = place(std::move(pattern));
    if (!placed) return fail(placed.error());
    patterns.push_back(std::move(*placed));
  }
  return SceneSyntax(std::move(patterns));
}

Result<ScenePattern> SceneReader::place(PatternSyntax pattern) {
  const bool first = slots_ == 0;
  if (first != (pattern.picture == 0) || pattern.slot > slots_) return refuse("a pattern out of order");
  const Timeline::Entry* const known = first ? nullptr : pictures_.find(pattern.picture);
  if (!first && known == nullptr) return refuse("a pattern of a picture without a state");
  const State seen = first ? state_of(pattern.state, setup_.steps) : known->state;
  if (first) {
    motion_.emplace(setup_, pattern.state);
    if (setup_.patterns > 1) blend_.emplace();
  }
  slots_ = std::max(slots_, pattern.slot + 1);
  return ScenePattern{std::move(pattern), seen};
}

Result<SceneSyntax> SceneReader::read_motion(const Packet& packet) {
  if (!motion_) return refuse("motion before the first pattern");
  auto group = motion_->decode(packet.payload);
  if (!group) return fail(group.error());
  const std::vector<State> states = states_of(*group, setup_.steps);
  std::vector<std::uint32_t> durations = group->durations;
  if (durations.empty()) durations.assign(states.size(), nominal_duration(setup_.format.frame_rate));
  if (auto added = pictures_.add(states, durations); !added) return fail(added.error());
  if (!blend_) pictures_.release_all();
  return SceneSyntax(std::move(*group));
}

Result<SceneSyntax> SceneReader::read_blend(const Packet& packet) {
  if (!blend_) return refuse("a blend packet where nothing is blended");
  auto group = blend_->decode(packet.payload);
  if (!group) return fail(group.error());
  if (auto released = pictures_.release(group->modes); !released) return fail(released.error());
  return SceneSyntax(std::move(*group));
}

// SPEC 6.3
Result<SceneSyntax> SceneReader::read_sound_setup(const Packet& packet) {
  sound_.reset();
  const auto setup = decode_sound_setup(packet.payload);
  if (!setup) return fail(setup.error());
  sound_ = *setup;
  return SceneSyntax(sound_);
}

Result<SceneSyntax> SceneReader::read_sound(const Packet& packet) {
  if (!sound_) return SceneSyntax{};
  auto group = decode_sound(packet.payload, *sound_);
  if (!group) return fail(group.error());
  if (group->first < next_sound_) return refuse("sound comes out of order");
  next_sound_ = group->first + static_cast<std::int64_t>(group->frames.size());
  return SceneSyntax(std::move(*group));
}

}  // namespace fbs
