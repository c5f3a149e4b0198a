#include "bitstream/payload/motion_payload.h"

#include <algorithm>
#include <cassert>

#include "bitstream/entropy/bit_counter.h"
#include "bitstream/entropy/range_coder.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/track.h"

namespace fbs {
namespace {

/// Probability that a group is not key, 1/65536. It has no context, since key groups begin those anew.
/// SPEC 4.5.
constexpr std::uint32_t kNotKey = 15 << 12;

// SPEC 4.5: one part's track. Returns false when what was read breaks a limit.
template <class Coder>
bool code_track(Coder& coder, TrackCoder<Coder>& tracks, std::size_t part, const CodedState& anchor,
                std::int32_t pictures, Track& track) {
  Knot last = anchor_knot(anchor, part);
  for (std::size_t k = 0; last.picture + 1 < pictures; ++k) {
    Knot next;
    if constexpr (!Coder::kReads) next = track[k];
    const std::int32_t left = pictures - 1 - last.picture;
    const std::int32_t length = tracks.span(part, left, k == 0, next.picture - last.picture);
    if (length > left) return false;
    next.picture = last.picture + length;
    if (!tracks.knot(part, length, last, next)) return false;
    if constexpr (Coder::kReads) {
      if (!coder.ok()) return false;
      track.push_back(next);
    }
    last = next;
  }
  return true;
}

// SPEC 4.5: everything behind the key flag. Returns false when what was read breaks a limit.
// @param after  called behind each part, and with kPartCount behind the durations
template <class Coder, class After>
bool code_body(Coder& coder, const CodedLimits& limits, TrackMemory& memory, MotionGroup& group,
               After&& after) {
  TrackCoder<Coder> tracks(coder, limits, memory);
  bool has_durations = !group.durations.empty();
  tracks.header(group.pictures, has_durations);
  if (group.pictures < 1) return false;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if ((limits.parts >> part & 1) == 0) continue;
    if (!code_track(coder, tracks, part, group.anchor, group.pictures, group.tracks[part])) return false;
    after(part);
  }
  if (has_durations) {
    group.durations.resize(static_cast<std::size_t>(group.pictures));
    for (std::uint32_t& duration : group.durations) {
      if (!tracks.duration(duration)) return false;
      if constexpr (Coder::kReads) {
        if (!coder.ok()) return false;
      }
    }
  }
  after(kPartCount);
  return true;
}

TrackMemory fresh_memory(std::uint32_t duration) {
  TrackMemory memory;
  memory.history.duration = duration;
  memory.history.older_duration = duration;
  return memory;
}

bool fits(const Track& track, std::size_t part, std::int32_t pictures, const CodedLimits& limits) {
  if ((limits.parts >> part & 1) == 0) return track.empty();
  std::int32_t last = -1;
  for (const Knot& knot : track) {
    if (knot.picture <= last) return false;
    last = knot.picture;
    for (std::size_t k = 0; k < kMaxPartSize; ++k) {
      const std::size_t i = kPartFirst[part] + k;
      const bool inside = k < kPartSizes[part]
                              ? knot.value[k] >= limits.least[i] && knot.value[k] <= limits.most[i]
                              : knot.value[k] == 0;
      if (!inside) return false;
    }
  }
  return last == pictures - 1;
}

Result<void> check_group(const MotionGroup& group, const CodedLimits& limits) {
  if (group.pictures < 1 || group.pictures > kMaxGroupPictures) {
    return fail(ErrorCode::kInvalidArgument, "a motion group has 1 to 256 pictures");
  }
  if (!group.durations.empty() && group.durations.size() != static_cast<std::size_t>(group.pictures)) {
    return fail(ErrorCode::kInvalidArgument, "a motion group has a duration for each picture or none");
  }
  const auto in_range = [](std::uint32_t d) { return d >= 1 && d <= kMaxDuration; };
  if (!std::all_of(group.durations.begin(), group.durations.end(), in_range)) {
    return fail(ErrorCode::kInvalidArgument, "a picture's duration is out of range");
  }
  for (std::size_t part = 0; part < kPartCount; ++part)
    if (!fits(group.tracks[part], part, group.pictures, limits))
      return fail(ErrorCode::kInvalidArgument, "a track has knots or numbers out of range");
  return {};
}

}  // namespace

MotionCoder::MotionCoder(const Setup& setup, const CodedState& seen)
    : limits_(setup.steps, setup.parts),
      nominal_duration_(nominal_duration(setup.format.frame_rate)),
      seen_(seen),
      last_(seen),
      memory_(fresh_memory(nominal_duration_)) {
  assert(check_setup(setup));
}

void MotionCoder::count(TrackMemory memory, MotionGroup group) {
  BitCounter counter;
  std::uint64_t so_far = 0;
  code_body(counter, limits_, memory, group, [&](std::size_t part) {
    costs_[part] += counter.bits_x256() - so_far;
    so_far = counter.bits_x256();
  });
}

Result<std::vector<std::uint8_t>> MotionCoder::encode(const MotionGroup& group) {
  if (auto checked = check_group(group, limits_); !checked) return fail(checked.error());
  if (needs_key_ && !group.key)
    return fail(ErrorCode::kInvalidArgument, "the first motion group must be a key group");
  if (group.anchor != anchor(group.key))
    return fail(ErrorCode::kInvalidArgument, "a motion group begins elsewhere than the last one ended");
  if (group.key) memory_ = fresh_memory(nominal_duration_);

  count(memory_, group);
  MotionGroup body = group;
  RangeEncoder encoder;
  encoder.raw_bit(kNotKey, group.key);
  code_body(encoder, limits_, memory_, body, [](std::size_t) {});
  last_ = last_of(group);
  needs_key_ = false;
  return encoder.finish();
}

Result<MotionGroup> MotionCoder::decode(std::span<const std::uint8_t> payload) {
  const bool needed_key = needs_key_;
  needs_key_ = true;  // until this group has been read

  RangeDecoder decoder(payload);
  MotionGroup group;
  group.key = decoder.raw_bit(kNotKey);
  if (needed_key && !group.key)
    return fail(ErrorCode::kInvalidStream, "motion packet refers to one that is missing");

  if (group.key) memory_ = fresh_memory(nominal_duration_);
  const TrackMemory before = memory_;
  group.anchor = anchor(group.key);
  const bool valid = code_body(decoder, limits_, memory_, group, [](std::size_t) {});
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "motion packet ends early", payload.size());
  if (!valid) return fail(ErrorCode::kInvalidStream, "motion packet has a value out of range");
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "motion packet has bytes too many");
  count(before, group);
  last_ = last_of(group);
  needs_key_ = false;
  return group;
}

}  // namespace fbs
