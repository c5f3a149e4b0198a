#include "bitstream/pattern/pattern_packet.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "bitstream/entropy/range_coder.h"
#include "bitstream/payload/whole_state.h"

namespace fbs {
namespace {

Result<void> check(const PatternSyntax& pattern, const Setup& setup, std::int32_t pictures) {
  if (pattern.slot < 0 || pattern.slot >= setup.patterns || (pattern.picture == 0 && pattern.slot != 0))
    return fail(ErrorCode::kInvalidArgument, "pattern's slot is out of range");
  if (pattern.picture < (pattern.alone ? 1 : 0) ||
      (pattern.picture > 0 && (pattern.picture < first_with_state(pictures) || pattern.picture >= pictures)))
    return fail(ErrorCode::kInvalidArgument, "pattern's picture is out of range");
  if (pattern.av1.empty() || pattern.av1.size() >= kMaxPayload)
    return fail(ErrorCode::kInvalidArgument, "pattern has no picture, or one of too many bytes");
  if (pattern.picture == 0 && !CodedLimits(setup.steps, setup.parts).hold(pattern.state))
    return fail(ErrorCode::kInvalidArgument, "pattern's seen state is out of range");
  return {};
}

/// @param open  whether the end of the code ends the last frame
/// @return nothing when the end would fall elsewhere
std::optional<std::vector<std::uint8_t>> written(std::span<const PatternSyntax> patterns, const Setup& setup,
                                                 std::int32_t pictures, bool open, PatternMemory& memory) {
  RangeEncoder encoder;
  const bool first = patterns.front().picture == 0, alone = patterns.front().alone;
  encoder.raw_bit(kNotKey, first);
  if (first) {
    memory = {};
    CodedState state = patterns.front().state;
    code_whole_state(encoder, CodedLimits(setup.steps, setup.parts), state);
  } else {
    encoder.raw_bit(kNotKey, alone);
    if (!alone) code_chain(encoder, memory, pictures);
  }
  for (const PatternSyntax& pattern : patterns) {
    const bool last = &pattern == &patterns.back();
    if (alone)
      code_place_alone(encoder, pictures, pattern);
    else if (!first)
      code_place(encoder, memory, pictures, pattern);
    memory.add(pattern);
    if (!encoder.bit(memory.has_length, !(open && last)))
      return write_open_frame(encoder, memory, pattern) ? std::optional(encoder.finish_open()) : std::nullopt;
    code_frame(encoder, memory, pattern);
    if (!first) encoder.bit(memory.has_next, !last);
  }
  return encoder.finish();
}

tl::unexpected<Error> out_of_range() {
  return fail(ErrorCode::kInvalidStream, "pattern packet has a value out of range");
}

}  // namespace

Result<std::vector<std::uint8_t>> PatternPacketWriter::encode(std::span<const PatternSyntax> patterns,
                                                              const Setup& setup, std::int32_t pictures) {
  if (patterns.empty() || patterns.size() > kMaxPatterns)
    return fail(ErrorCode::kInvalidArgument, "a pattern packet has 1 to 64 patterns");
  for (const PatternSyntax& pattern : patterns) {
    if (auto checked = check(pattern, setup, pictures); !checked) return fail(checked.error());
    if ((pattern.picture == 0 || pattern.alone) && patterns.size() > 1)
      return fail(ErrorCode::kInvalidArgument, "a pattern is not alone in its packet");
  }
  const bool alone = patterns.front().alone;
  const PatternMemory before = alone ? PatternMemory{} : memory_;
  PatternMemory memory = before;
  auto payload = written(patterns, setup, pictures, true, memory);
  if (!payload) {
    memory = before;
    payload = written(patterns, setup, pictures, false, memory);
  }
  if (payload->size() > kMaxPayload)
    return fail(ErrorCode::kInvalidArgument, "pattern packet has too many bytes");
  if (alone) return std::move(*payload);
  memory_ = memory;
  ++memory_.packets;
  return std::move(*payload);
}

Result<std::vector<std::uint8_t>> encode_first_pattern(const PatternSyntax& pattern, const Setup& setup) {
  constexpr std::int32_t kPicturesBefore = 0;  // no picture has a state yet
  return PatternPacketWriter().encode({&pattern, 1}, setup, kPicturesBefore);
}

Result<std::vector<PatternSyntax>> PatternPacketReader::decode(std::span<const std::uint8_t> payload,
                                                               const Setup& setup, std::int32_t pictures) {
  RangeDecoder decoder(payload);
  const bool first = decoder.raw_bit(kNotKey);
  if (needs_first_ && !first)
    return fail(ErrorCode::kInvalidStream, "a pattern before the first of its scene");
  const bool alone = !first && decoder.raw_bit(kNotKey);
  if (!first && !alone) broken_ = !code_chain(decoder, memory_, pictures) || broken_;
  if (!first && !alone && broken_) return std::vector<PatternSyntax>{};

  PatternMemory memory;
  if (!first && !alone) memory = memory_;
  auto patterns = read(decoder, setup, pictures, first, alone, memory);
  if (patterns && !decoder.at_end())
    patterns = fail(ErrorCode::kInvalidStream, "pattern packet has excess bytes");
  if (alone) return patterns;
  broken_ = !patterns;
  if (!patterns) return patterns;
  needs_first_ = false;
  memory_ = memory;
  ++memory_.packets;
  return patterns;
}

Result<std::vector<PatternSyntax>> PatternPacketReader::read(RangeDecoder& decoder, const Setup& setup,
                                                             std::int32_t pictures, bool first, bool alone,
                                                             PatternMemory& memory) {
  std::vector<PatternSyntax> patterns;
  PatternSyntax pattern;
  if (first && !code_whole_state(decoder, CodedLimits(setup.steps, setup.parts), pattern.state))
    return out_of_range();
  bool more = true;
  while (more) {
    if (patterns.size() == kMaxPatterns)
      return fail(ErrorCode::kTooLarge, "pattern packet has more patterns than a store");
    pattern.alone = alone;
    if (alone)
      code_place_alone(decoder, pictures, pattern);
    else if (!first && !code_place(decoder, memory, pictures, pattern))
      return out_of_range();
    if (pattern.slot >= setup.patterns) return fail(ErrorCode::kTooLarge, "pattern's slot is out of range");
    if (alone && pattern.picture < 1) return out_of_range();
    memory.add(pattern);
    more = decoder.bit(memory.has_length);
    if (more) {
      if (code_frame(decoder, memory, pattern)) more = !first && decoder.bit(memory.has_next);
    } else {
      read_open_frame(decoder, memory, pattern);
    }
    if (!decoder.ok()) return fail(ErrorCode::kTruncated, "pattern packet ends early");
    patterns.push_back(std::exchange(pattern, {}));
    if (alone) break;
  }
  return patterns;
}

}  // namespace fbs
