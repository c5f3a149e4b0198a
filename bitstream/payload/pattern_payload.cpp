#include "bitstream/payload/pattern_payload.h"

#include "bitstream/byte_io.h"
#include "bitstream/entropy/range_coder.h"
#include "bitstream/payload/whole_state.h"

namespace fbs {

Result<std::vector<std::uint8_t>> encode_pattern(const PatternSyntax& pattern, const Setup& setup) {
  if (pattern.index < 0 || pattern.index >= kMaxPatterns) {
    return fail(ErrorCode::kInvalidArgument, "pattern index is out of range");
  }
  if (pattern.av1.empty()) return fail(ErrorCode::kInvalidArgument, "pattern has no picture");
  const CodedLimits limits(setup.steps, setup.parts);
  CodedState state = pattern.state;
  if (!limits.hold(state)) return fail(ErrorCode::kInvalidArgument, "pattern's seen state is out of range");

  RangeEncoder encoder;
  code_whole_state(encoder, limits, state);
  const std::vector<std::uint8_t> coded_state = encoder.finish();

  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  writer.varint(static_cast<std::uint64_t>(pattern.index));
  writer.varint(coded_state.size());
  writer.bytes(coded_state);
  writer.bytes(pattern.av1);
  return payload;
}

Result<PatternSyntax> decode_pattern(std::span<const std::uint8_t> payload, const Setup& setup) {
  // SPEC 4.4
  ByteReader reader(payload);
  const std::uint64_t index = reader.varint();
  const std::uint64_t state_size = reader.varint();
  const auto coded_state = reader.bytes(state_size);
  const auto av1 = reader.rest();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "pattern packet ends early");
  if (reader.malformed()) return fail(ErrorCode::kInvalidStream, "pattern packet is damaged");
  if (index >= kMaxPatterns) return fail(ErrorCode::kTooLarge, "pattern index is out of range");
  if (av1.empty()) return fail(ErrorCode::kInvalidStream, "pattern packet has no picture");

  const CodedLimits limits(setup.steps, setup.parts);
  RangeDecoder decoder(coded_state);
  CodedState state{};
  const bool in_range = code_whole_state(decoder, limits, state);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "pattern's seen state ends early");
  if (!in_range || !decoder.at_end())
    return fail(ErrorCode::kInvalidStream, "pattern's seen state is out of range");

  return PatternSyntax{static_cast<std::int32_t>(index), state, {av1.begin(), av1.end()}};
}

}  // namespace fbs
