#include "bitstream/scene/scene_reader.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bitstream/byte_io.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/head_part_payload.h"
#include "bitstream/payload/return_payload.h"
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

/// How many of the first states of a group are uncertain, the missing pictures included. SPEC 6.2.
std::int32_t guesses_of(const MotionGroup& group) {
  if (group.unsure) return group.missing + group.pictures;
  if (group.missing == 0) return 0;
  std::int32_t before_knots = 0;
  for (const Track& track : group.tracks)
    if (!track.empty()) before_knots = std::max(before_knots, track.front().picture);
  return group.missing + before_knots;
}

}  // namespace

Result<SceneSyntax> SceneReader::read(const Packet& packet) {
  auto syntax = read_payload(packet);
  if (syntax) return syntax;
  if (is_of_scene(packet.type) || enters_scene(packet.type)) lose();
  Error error = std::move(syntax.error());
  error.byte_offset = packet.offset;
  return fail(std::move(error));
}

void SceneReader::lose() {
  has_losses_ = true;
  lost_ = lost_ || !motion_;
}

void SceneReader::go_back(const SceneReader& before) {
  const std::int32_t displayed = pictures_.displayed();
  const std::int64_t next_sound = next_sound_;
  *this = before;
  pictures_.skip_displayed(displayed);
  next_sound_ = next_sound;
  has_losses_ = true;
}

Result<SceneSyntax> SceneReader::read_payload(const Packet& packet) {
  if (packet.type == PacketType::kSetup) return read_setup(packet);
  if (packet.type == PacketType::kReturn) return read_return(packet);
  if (packet.type == PacketType::kEnd) return as_syntax(decode_end(packet.payload));
  if (packet.type == PacketType::kSound) return read_sound(packet);
  if (packet.type == PacketType::kHeadPart) return read_head_part(packet);
  if (packet.type != PacketType::kSoundSetup && (!is_of_scene(packet.type) || lost_))
    return SceneSyntax{};  // SPEC 3.1, 6.2: skipped
  if (!has_setup()) return has_losses_ ? Result<SceneSyntax>{} : refuse("a packet before the setup");
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
    case PacketType::kUnit:
      return read_unit(packet);
    default:
      return read_sound_setup(packet);
  }
}

Result<SceneSyntax> SceneReader::skip(bool needs_missing) const {
  if (needs_missing && !has_losses_) return refuse("a packet is missing");
  return SceneSyntax{};
}

Result<SceneSyntax> SceneReader::skip_group(bool needs_key) {
  waits_for_key_ = waits_for_key_ || needs_key;
  return skip(needs_key);
}

// SPEC 6.1
Result<SceneSyntax> SceneReader::read_setup(const Packet& packet) {
  const StreamPosition passed = packet.in_parts ? passed_ : StreamPosition{};
  const auto setup = decode_setup(packet.payload);
  if (!setup) {
    lost_ = true;
    aside_.clear();
    return fail(setup.error());
  }
  if (setup->keeps == SceneKeeping::kAndPresent) set_aside();
  if (setup->keeps == SceneKeeping::kNone) aside_.clear();
  enter({});
  if (setup->keeps == SceneKeeping::kNone) earlier_losses_ = false;
  sound_.reset();
  scene_ = ++scenes_;
  setup_ = *setup;
  Setup joined = setup_;
  joined.before.pictures += passed.pictures;
  joined.before.time += passed.time;
  pictures_ = Timeline(joined.before, static_cast<std::int32_t>(passed.pictures));
  has_losses_ = passed.pictures > 0;
  return SceneSyntax(joined);
}

// SPEC 6.6
Result<SceneSyntax> SceneReader::read_return(const Packet& packet) {
  const auto to = decode_return(packet.payload);
  if (!to) {
    lose_scene();
    return fail(to.error());
  }
  if (!can_return() || check_ != to->scene) {  // otherwise the return that left it is lost
    const auto next = take_out(to->scene);
    if (to->aside) set_aside();
    if (!next) {
      const bool explained = has_losses_ || earlier_losses_;
      lose_scene();
      return explained ? Result<SceneSyntax>{} : refuse("a return to a scene that is not known");
    }
    enter(*next);
  }
  has_losses_ = has_losses_ || earlier_losses_;  // its return may have been lost
  pictures_.skip_displayed(static_cast<std::int32_t>(to->passed));
  pictures_.go_on(to->before);
  return SceneSyntax(*to);
}

void SceneReader::set_aside() {
  if (!can_return()) return;
  auto scene = std::make_shared<SceneReader>(*this);
  scene->aside_.clear();
  aside_.push_back(std::move(scene));
  if (aside_.size() > kKeptScenes) aside_.erase(aside_.begin());
}

std::shared_ptr<const SceneReader> SceneReader::take_out(std::uint32_t check) {
  const auto found =
      std::find_if(aside_.rbegin(), aside_.rend(), [&](const auto& scene) { return scene->check_ == check; });
  if (found == aside_.rend()) return nullptr;
  std::shared_ptr<const SceneReader> scene = std::move(*found);
  aside_.erase(std::prev(found.base()));
  return scene;
}

void SceneReader::enter(SceneReader scene) {
  scene.next_sound_ = next_sound_;
  scene.sound_ = sound_;
  scene.aside_ = std::move(aside_);
  scene.scenes_ = scenes_;
  scene.earlier_losses_ = earlier_losses_ || has_losses_ || !has_setup();
  *this = std::move(scene);
}

bool SceneReader::knows(std::uint64_t scene) const {
  return scene == scene_ ||
         std::any_of(aside_.begin(), aside_.end(), [&](const auto& aside) { return aside->scene_ == scene; });
}

// SPEC 6.5
Result<SceneSyntax> SceneReader::read_head_part(const Packet& packet) {
  auto part = decode_head_part(packet.payload);
  if (!part) return fail(part.error());
  if (packet.in_parts || (motion_ && !lost_ && part->scene == static_cast<std::uint16_t>(check_)))
    return SceneSyntax{};
  const StreamPosition passed = part->passed;
  auto head = head_parts_.add(std::move(*part));
  if (!head) return SceneSyntax{};
  passed_ = passed;
  return SceneSyntax(JoinedHead{std::move(*head)});
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
  if (!motion_) check_ = packet.check;
  std::vector<ScenePattern> patterns;
  for (PatternSyntax& pattern : *read) {
    auto placed = place(std::move(pattern));
    if (!placed) {
      lose_patterns();
      return fail(placed.error());
    }
    if (!*placed) break;  // those behind it need it
    patterns.push_back(std::move(**placed));
  }
  if (patterns.empty()) return skip(patterns_.is_broken());
  return SceneSyntax(std::move(patterns));
}

// SPEC 6
Result<std::optional<ScenePattern>> SceneReader::place(PatternSyntax pattern) {
  const bool first = !motion_;
  if (first != (pattern.picture == 0)) return refuse("a pattern out of order");
  if (first) {
    const auto begin = static_cast<std::uint64_t>(pictures_.end());
    motion_.emplace(setup_, pattern.state, StreamPosition{begin, pictures_.end_time() - setup_.before.time});
    if (setup_.patterns > 1) blend_.emplace(pictures_.end());
    if (begin > 0) patterns_.lose();  // those before the joining
    const State seen = state_of(pattern.state, setup_.steps);
    return ScenePattern{std::move(pattern), seen};
  }
  std::int32_t& stored = stored_[pattern.slot];
  if (pattern.alone && pattern.picture <= stored) return std::nullopt;
  const Timeline::Entry* const known = pictures_.find(pattern.picture);
  if (known != nullptr && !known->guessed) {
    stored = pattern.picture;
    return ScenePattern{std::move(pattern), known->state};
  }
  if (!has_losses_) return refuse("a pattern of a picture without a state");
  if (!pattern.alone) lose_patterns();
  return std::nullopt;
}

Result<std::optional<MotionGroup>> SceneReader::add_motion(std::span<const std::uint8_t> payload) {
  if (!motion_) return refuse("motion before the first pattern");
  auto group = motion_->decode(payload);
  if (!group || !*group) return group;
  const std::vector<State> states = states_of(**group, setup_.steps);
  const std::vector<std::uint32_t> durations = durations_of(**group, setup_.format.frame_rate);
  if ((*group)->missing > 0) has_losses_ = true;
  if (auto added = pictures_.add(states, durations, guesses_of(**group)); !added) {
    lose_scene();  // its pictures have lost their numbers
    return fail(added.error());
  }
  return group;
}

Result<SceneSyntax> SceneReader::read_motion(const Packet& packet) {
  auto group = add_motion(packet.payload);
  if (!group) return fail(group.error());
  if (!*group) return skip_group(motion_->needs_key());
  if (!blend_) {
    waits_for_key_ = false;
    pictures_.release_all();
  }
  return SceneSyntax(std::move(**group));
}

Result<SceneSyntax> SceneReader::read_blend(const Packet& packet) {
  if (!blend_) return refuse("a blend packet where nothing is blended");
  auto group = blend_->decode(packet.payload);
  if (!group) return fail(group.error());
  if (!*group) return skip_group(blend_->needs_key());
  waits_for_key_ = false;
  if (auto released = pictures_.release((*group)->first, (*group)->modes); !released)
    return fail(released.error());
  return SceneSyntax(std::move(**group));
}

// SPEC 4.11
Result<SceneSyntax> SceneReader::read_unit(const Packet& packet) {
  if (!blend_) return refuse("a unit where nothing is blended");
  ByteReader reader(packet.payload);
  const std::uint64_t size = reader.varint();
  const auto motion = reader.bytes(size);
  if (reader.malformed()) return refuse("a unit has a damaged length");
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "a unit ends early");
  auto group = add_motion(motion);
  if (!group) return fail(group.error());
  if (!*group) return skip_group(motion_->needs_key());
  auto blend = blend_->decode_in_unit(packet.payload.subspan(reader.offset()), **group);
  if (!blend) return fail(blend.error());
  waits_for_key_ = !*blend && blend_->needs_key();
  if (!*blend) return SceneSyntax(std::move(**group));
  if (auto released = pictures_.release((*blend)->first, (*blend)->modes); !released)
    return fail(released.error());
  return SceneSyntax(Unit{std::move(**group), std::move(**blend)});
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
  if (group->first < next_sound_)
    return has_losses_ ? Result<SceneSyntax>{} : refuse("sound comes out of order");
  next_sound_ = group->first + static_cast<std::int64_t>(group->frames.size());
  return SceneSyntax(std::move(*group));
}

}  // namespace fbs
