#include "bitstream/payload/pattern_payload.h"

#include "bitstream/byte_io.h"
#include "bitstream/entropy/range_coder.h"
#include "bitstream/payload/whole_state.h"

namespace fbs {
namespace {

Result<CodedState> decode_seen_state(std::span<const std::uint8_t> code, const Setup& setup) {
  const CodedLimits limits(setup.steps, setup.parts);
  RangeDecoder decoder(code);
  CodedState state{};
  const bool in_range = code_whole_state(decoder, limits, state);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "pattern's seen state ends early");
  if (!in_range || !decoder.at_end())
    return fail(ErrorCode::kInvalidStream, "pattern's seen state is out of range");
  return state;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_pattern(const PatternSyntax& pattern, const Setup& setup) {
  if (pattern.slot < 0 || pattern.slot >= setup.patterns || (pattern.picture == 0 && pattern.slot != 0))
    return fail(ErrorCode::kInvalidArgument, "pattern's slot is out of range");
  if (pattern.picture < 0) return fail(ErrorCode::kInvalidArgument, "pattern's picture is out of range");
  if (pattern.av1.empty()) return fail(ErrorCode::kInvalidArgument, "pattern has no picture");
  const CodedLimits limits(setup.steps, setup.parts);
  CodedState state = pattern.state;
  if (!limits.hold(state)) return fail(ErrorCode::kInvalidArgument, "pattern's seen state is out of range");

  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  const bool first = pattern.picture == 0;
  writer.varint(first ? 0 : static_cast<std::uint64_t>(pattern.slot) + 1);
  if (!first) {
    writer.varint(static_cast<std::uint64_t>(pattern.picture));
  } else {
    RangeEncoder encoder;
    code_whole_state(encoder, limits, state);
    const std::vector<std::uint8_t> coded_state = encoder.finish();
    writer.varint(coded_state.size());
    writer.bytes(coded_state);
  }
  writer.bytes(pattern.av1);
  return payload;
}

Result<PatternSyntax> decode_pattern(std::span<const std::uint8_t> payload, const Setup& setup) {
  // SPEC 4.4
  ByteReader reader(payload);
  const std::uint64_t place = reader.varint(), slot = place == 0 ? 0 : place - 1;
  const std::uint64_t number = reader.varint();
  const auto coded_state = reader.bytes(place == 0 ? number : 0);
  const auto av1 = reader.rest();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "pattern packet ends early");
  if (reader.malformed()) return fail(ErrorCode::kInvalidStream, "pattern packet is damaged");
  if (slot >= static_cast<std::uint64_t>(setup.patterns))
    return fail(ErrorCode::kTooLarge, "pattern's slot is out of range");
  if (place != 0 && number == 0)
    return fail(ErrorCode::kInvalidStream, "a later pattern is that of picture 0");
  if (place != 0 && number > kMaxPictureNumber)
    return fail(ErrorCode::kTooLarge, "pattern's picture is out of range");
  if (av1.empty()) return fail(ErrorCode::kInvalidStream, "pattern packet has no picture");

  PatternSyntax pattern;
  pattern.slot = static_cast<std::int32_t>(slot);
  pattern.picture = place == 0 ? 0 : static_cast<std::int32_t>(number);
  pattern.av1.assign(av1.begin(), av1.end());
  if (place == 0) {
    auto state = decode_seen_state(coded_state, setup);
    if (!state) return fail(state.error());
    pattern.state = *state;
  }
  return pattern;
}

}  // namespace fbs
