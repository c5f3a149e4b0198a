#include "bitstream/motion_payload.h"

#include <algorithm>
#include <cassert>

#include "bitstream/bit_counter.h"
#include "bitstream/byte_io.h"
#include "bitstream/range_coder.h"
#include "bitstream/setup.h"

namespace fbs {
namespace {

// Flags of the group's header, below the number of pictures. SPEC 4.5.
constexpr std::uint64_t kKeyFlag = 1;
constexpr std::uint64_t kDurationsFlag = 2;
constexpr int kCountShift = 2;

/// A group between header and bits.
struct Body {
  bool key = false;
  bool has_durations = false;
  PredictionChoice damped = 0;
  std::vector<FlatState> states;
  std::vector<std::uint32_t> durations;  // as many as states if has_durations
};

// SPEC 4.5: everything behind the header. Returns false when what was read breaks a limit.
template <class Coder>
bool code_body(Coder& coder, const StateLimits& limits, MotionMemory& memory, Body& body) {
  StateCoder<Coder> states(coder, limits, memory);
  body.damped = states.choice(body.damped);
  for (std::size_t i = 0; i < body.states.size(); ++i) {
    if (body.has_durations && !states.duration(body.durations[i])) return false;
    const bool whole = body.key && i == 0;
    if (!(whole ? states.whole(body.states[i]) : states.next(body.states[i], body.damped))) return false;
    if constexpr (Coder::kReads) {
      if (!coder.ok()) return false;
    }
  }
  return true;
}

std::uint64_t cost_of_body(const StateLimits& limits, MotionMemory memory, Body& body) {
  BitCounter counter;
  code_body(counter, limits, memory, body);
  return counter.cost();
}

// Tries for one part after the other whether the damped velocity predicts it better.
PredictionChoice best_choice(const StateLimits& limits, const MotionMemory& memory, Body& body) {
  body.damped = 0;
  std::uint64_t least = cost_of_body(limits, memory, body);
  PredictionChoice best = 0;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if ((limits.coded >> part & 1) == 0) continue;
    body.damped = static_cast<PredictionChoice>(best | 1 << part);
    const PredictionChoice tried = body.damped;
    const std::uint64_t cost = cost_of_body(limits, memory, body);
    if (cost < least) {
      least = cost;
      best = tried;
    }
  }
  return best;
}

MotionMemory fresh_memory(std::uint32_t duration) {
  MotionMemory memory;
  memory.history.duration = duration;
  memory.history.older_duration = duration;
  return memory;
}

Result<void> check_group(const MotionGroup& group, const StateLimits& limits) {
  if (group.states.empty() || group.states.size() > kMaxGroupPictures) {
    return fail(ErrorCode::kInvalidArgument, "a motion group has 1 to 256 pictures");
  }
  if (!group.durations.empty() && group.durations.size() != group.states.size()) {
    return fail(ErrorCode::kInvalidArgument, "a motion group has a duration for each picture or none");
  }
  const auto in_range = [](std::uint32_t d) { return d >= 1 && d <= kMaxDuration; };
  if (!std::all_of(group.durations.begin(), group.durations.end(), in_range)) {
    return fail(ErrorCode::kInvalidArgument, "a picture's duration is out of range");
  }
  const auto inside = [&](const State& state) { return limits.hold(flatten(state)); };
  if (!std::all_of(group.states.begin(), group.states.end(), inside)) {
    return fail(ErrorCode::kInvalidArgument, "a state is out of range");
  }
  return {};
}

}  // namespace

MotionCoder::MotionCoder(const Setup& setup)
    : limits_(setup),
      nominal_duration_(nominal_duration(setup.format.frame_rate)),
      memory_(fresh_memory(nominal_duration_)) {
  assert(check_setup(setup));
}

Result<std::vector<std::uint8_t>> MotionCoder::encode(const MotionGroup& group) {
  if (auto checked = check_group(group, limits_); !checked) return tl::unexpected(checked.error());
  if (needs_key_ && !group.key)
    return fail(ErrorCode::kInvalidArgument, "the first motion group must be a key group");

  Body body{.key = group.key,
            .has_durations = !group.durations.empty(),
            .damped = 0,
            .states = {},
            .durations = group.durations};
  for (const State& state : group.states) body.states.push_back(flatten(state));

  if (group.key) memory_ = fresh_memory(nominal_duration_);
  body.damped = best_choice(limits_, memory_, body);

  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  writer.varint((group.states.size() - 1) << kCountShift | (body.has_durations ? kDurationsFlag : 0) |
                (body.key ? kKeyFlag : 0));
  RangeEncoder encoder;
  code_body(encoder, limits_, memory_, body);
  writer.bytes(encoder.finish());
  needs_key_ = false;
  return payload;
}

Result<MotionGroup> MotionCoder::decode(std::span<const std::uint8_t> payload) {
  const bool needed_key = needs_key_;
  needs_key_ = true;  // until this group has been read

  ByteReader reader(payload);
  const std::uint64_t header = reader.varint();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "motion packet ends early");
  if (reader.malformed()) return fail(ErrorCode::kInvalidStream, "motion packet has a damaged header");
  if (header >> kCountShift >= kMaxGroupPictures) {
    return fail(ErrorCode::kTooLarge, "motion packet has more than 256 pictures");
  }
  Body body;
  body.key = (header & kKeyFlag) != 0;
  body.has_durations = (header & kDurationsFlag) != 0;
  if (needed_key && !body.key)
    return fail(ErrorCode::kInvalidStream, "motion packet refers to one that is missing");
  body.states.resize(static_cast<std::size_t>(header >> kCountShift) + 1);
  if (body.has_durations) body.durations.resize(body.states.size());

  if (body.key) memory_ = fresh_memory(nominal_duration_);
  RangeDecoder decoder(reader.rest());
  const bool valid = code_body(decoder, limits_, memory_, body);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "motion packet ends early", payload.size());
  if (!valid) return fail(ErrorCode::kInvalidStream, "motion packet has a value out of range");
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "motion packet has bytes too many");

  MotionGroup group;
  group.key = body.key;
  group.durations = std::move(body.durations);
  group.states.reserve(body.states.size());
  for (const FlatState& state : body.states) group.states.push_back(unflatten(state));
  needs_key_ = false;
  return group;
}

MotionCounter::MotionCounter(const MotionCoder& coder, bool key, PredictionChoice damped)
    : limits_(coder.limits()), memory_(coder.memory()), damped_(damped), key_next_(key || coder.needs_key()) {
  if (key_next_) memory_ = MotionMemory{};
}

std::uint32_t MotionCounter::push(const State& state) {
  FlatState flat = flatten(state);
  assert(limits_.hold(flat));
  BitCounter counter;
  StateCoder<BitCounter> states(counter, limits_, memory_);
  if (key_next_) {
    states.whole(flat);
    key_next_ = false;
  } else {
    states.next(flat, damped_);
  }
  total_ += counter.bits_x256();
  return static_cast<std::uint32_t>(counter.bits_x256());
}

}  // namespace fbs
