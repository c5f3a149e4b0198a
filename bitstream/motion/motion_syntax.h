// The layout of a motion packet, described once for writing, reading and counting. SPEC 4.5.
//
// Coder is RangeEncoder, RangeDecoder or BitCounter; Group is MotionGroup for the one that reads and
// const MotionGroup for the others.
#pragma once

#include <cstdint>

#include "bitstream/group_number.h"
#include "bitstream/motion/duration_coder.h"
#include "bitstream/motion/track_coder.h"
#include "bitstream/syntax.h"
#include "bitstream/track.h"

namespace fbs {

/// What adapts from group to group of a scene: contexts, mixers and history.
struct MotionMemory {
  AdaptiveBit other_count;
  AdaptiveBit has_durations;
  std::int32_t pictures = 0;  ///< of the last group
  TrackContexts tracks;
  std::array<AdaptiveBit, kPartCount> held;  ///< whether the first knots of a key group are as before it
  TrackContexts from_rest;                   ///< of those that are not
  TrackHistory track_history;
  DurationContexts durations;
  DurationHistory duration_history;
};

/// Calls f(context) for each context but those of durations, in the order of SPEC 5.4.
template <class F>
void for_each_context(MotionMemory& memory, F&& f) {
  f(memory.other_count);
  f(memory.has_durations);
  for_each_context(memory.tracks, f);
  for_each_context(memory.held, f);
  for_each_context(memory.from_rest, f);
}

/// What the next group of a scene is coded against. Writer, reader and counter of a scene each have one, and
/// all are equal after the same groups. Plain data: a copy continues independently.
struct MotionReference {
  /// @param setup  of the scene; must satisfy check_setup (assert)
  /// @param seen_state  of the first pattern
  MotionReference(const Setup& setup, const CodedState& seen_state);

  /// Returns contexts to what they know before a scene begins, and mixers and history to their initial
  /// values, as each key group does.
  void reset();
  /// A group has been coded.
  void end(const MotionGroup& group);

  CodedLimits limits;
  std::uint32_t nominal_duration;  ///< 1/90000 s
  CodedState seen;                 ///< of the first pattern
  CodedState last;                 ///< of the last picture: the anchor of the next group. SPEC 5.2
  std::uint32_t time = 0;          ///< of the next group, 1/90000 s since the start of the scene, modulo 2^32
  GroupOrder order;
  std::array<int, kPartCount> held{};  ///< key groups in a row that have left a part as it was
  PartMask unknown = 0;                ///< parts that a reader who has joined has not got yet
  /// A key group sends each part that the group before it has moved, for those who missed that. Readers leave
  /// it as it is.
  bool repeats_moved = false;
  MotionMemory memory;
};

inline constexpr int kTimeBits = 22;  ///< of the time of a key group, 1/90000 s

/// Codes when a key group with durations begins, so that it gets its time even if groups before it are
/// missing.
/// @param time  sum of the durations before it in the scene as far as they are known, 1/90000 s
template <class Coder>
void code_time(Coder& coder, std::uint32_t time, MotionGroup& group) {
  constexpr std::uint32_t kLow = (1u << kTimeBits) - 1;
  const std::uint32_t low = coder.bypass(kTimeBits, time & kLow);
  group.missing_time = (low - time) & kLow;
}
template <class Coder>
void code_time(Coder& coder, std::uint32_t time, const MotionGroup& group) {
  coder.bypass(kTimeBits, (time + group.missing_time) & ((1u << kTimeBits) - 1));
}

/// Codes the number of pictures and whether there are durations; returns the latter.
template <class Coder, class Group>
bool code_header(Coder& coder, MotionMemory& memory, Group& group) {
  std::int32_t pictures = memory.pictures;
  if (coder.bit(memory.other_count, group.pictures != memory.pictures))
    pictures = static_cast<std::int32_t>(coder.bypass(8, static_cast<std::uint32_t>(group.pictures - 1))) + 1;
  static_assert(kMaxGroupPictures == 1 << 8);
  if constexpr (Coder::kReads) group.pictures = pictures;
  memory.pictures = pictures;
  return coder.bit(memory.has_durations, !group.durations.empty());
}

/// A part that does not move is sent again after so many key groups, for those who have missed it.
inline constexpr int kMaxHeld = 5;

/// Codes the first knot of a part in a key group: as it was, or what it differs by from the rest state.
/// @param last  the anchor
/// @return false when what was read is out of range
template <class Coder>
bool code_key_knot(Coder& coder, MotionReference& reference, std::size_t part, const Knot& last, Knot& next) {
  int& held = reference.held[part];
  const bool holds = coder.bit(reference.memory.held[part], next.value == last.value && held < kMaxHeld);
  held = holds ? held + 1 : 0;
  if (holds) {
    next.value = last.value;
    return true;
  }
  reference.unknown = static_cast<PartMask>(reference.unknown & ~(1U << part));
  TrackHistory none;
  TrackCoder<Coder> tracks(coder, reference.limits, reference.memory.from_rest, none);
  return tracks.knot(part, 1, anchor_knot(reference.seen, part), next);
}

/// Codes the track of one part.
/// @return false when what was read is out of range or ends early
template <class Coder, class Group>
bool code_track(Coder& coder, MotionReference& reference, std::size_t part, Group& group) {
  TrackCoder<Coder> tracks(coder, reference.limits, reference.memory.tracks, reference.memory.track_history);
  auto& track = group.tracks[part];
  const bool key = group.key && group.first > 0;  // at the start of a scene the anchor is the rest state
  Knot last = anchor_knot(group.anchor, part);
  for (std::size_t k = 0; last.picture + 1 < group.pictures; ++k) {
    Knot next;
    if constexpr (!Coder::kReads) next = track[k];
    const std::int32_t left = group.pictures - 1 - last.picture;
    const std::int32_t length = tracks.span(part, left, k == 0, next.picture - last.picture);
    if (length > left) return false;
    next.picture = last.picture + length;
    if (key && k == 0) {
      if (!code_key_knot(coder, reference, part, last, next)) return false;
    } else if (!tracks.knot(part, length, last, next)) {
      return false;
    }
    if constexpr (Coder::kReads) {
      if (!coder.ok()) return false;
      track.push_back(next);
    }
    last = next;
  }
  if (reference.repeats_moved && last.value != anchor_knot(group.anchor, part).value)
    reference.held[part] = kMaxHeld;
  return true;
}

/// Codes the duration of each picture.
/// @return false when what was read is out of range or ends early
template <class Coder, class Group>
bool code_durations(Coder& coder, MotionMemory& memory, Group& group) {
  if constexpr (Coder::kReads) group.durations.resize(group.pictures);
  for (auto& duration : group.durations) {
    if (!code_duration(coder, memory.durations, memory.duration_history, duration)) return false;
    if constexpr (Coder::kReads) {
      if (!coder.ok()) return false;
    }
  }
  return true;
}

/// Codes all that follows the number of the first picture.
/// @param group  its key flag, first picture and anchor are set; all else too, with a Coder that does not
/// read
/// @param after  called with each part after it is coded, and with kPartCount after the durations
/// @return false when what was read is out of range or ends early
template <class Coder, class Group, class After>
bool code_body(Coder& coder, MotionReference& reference, Group& group, After&& after) {
  const bool has_durations = code_header(coder, reference.memory, group);
  if (group.pictures < 1) return false;
  if constexpr (Coder::kReads)
    group.missing_time = static_cast<std::uint32_t>(group.missing) * reference.nominal_duration;
  if (has_durations && group.key && group.first > 0) {
    code_time(coder, reference.time, group);
    if (group.missing_time < static_cast<std::uint32_t>(group.missing)) return false;
  }
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if (!has_part(reference.limits.parts, part)) continue;
    if (!code_track(coder, reference, part, group)) return false;
    after(part);
  }
  if (has_durations && !code_durations(coder, reference.memory, group)) return false;
  after(kPartCount);
  return true;
}

}  // namespace fbs
