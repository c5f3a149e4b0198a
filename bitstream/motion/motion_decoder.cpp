#include "bitstream/motion/motion_decoder.h"

#include <utility>

#include "bitstream/entropy/range_coder.h"

namespace fbs {

MotionDecoder::MotionDecoder(const Setup& setup, const CodedState& seen, const StreamPosition& passed)
    : reference_(setup, seen) {
  reference_.order.next = static_cast<std::int32_t>(passed.pictures);
  reference_.time = static_cast<std::uint32_t>(passed.time);
  if (passed.pictures > 0) reference_.unknown = setup.parts;
}

Result<std::optional<MotionGroup>> MotionDecoder::decode(std::span<const std::uint8_t> payload) {
  RangeDecoder decoder(payload);
  MotionGroup group;
  group.key = decoder.raw_bit(kNotKey);
  group.first = code_first(decoder, 0, reference_.order.next);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "motion packet ends early", payload.size());
  if (!group.key && group.first == 0)
    return fail(ErrorCode::kInvalidStream, "the first motion packet of a scene is not key");
  const auto missing = reference_.order.begin(group.key, group.first);
  if (!missing) return std::nullopt;
  group.missing = *missing;
  if (group.key) reference_.reset();
  group.anchor = reference_.last;
  group.unsure = reference_.unknown != 0;
  const bool valid = code_body(decoder, reference_, group, [](std::size_t) {});
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "motion packet ends early", payload.size());
  if (!valid) return fail(ErrorCode::kInvalidStream, "motion packet has a value out of range");
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "motion packet has excess bytes");
  reference_.end(group);
  return group;
}

}  // namespace fbs
