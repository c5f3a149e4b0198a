#include "bitstream/motion/motion_decoder.h"

#include <utility>

#include "bitstream/entropy/range_coder.h"

namespace fbs {

Result<MotionGroup> MotionDecoder::decode(std::span<const std::uint8_t> payload) {
  const bool needed_key = std::exchange(reference_.needs_key, true);  // until the whole group has been read
  RangeDecoder decoder(payload);
  MotionGroup group;
  group.key = decoder.raw_bit(kNotKey);
  if (needed_key && !group.key)
    return fail(ErrorCode::kInvalidStream, "motion packet depends on a missing one");

  if (group.key) reference_.reset();
  group.anchor = reference_.anchor(group.key);
  const bool valid = code_body(decoder, reference_, group, [](std::size_t) {});
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "motion packet ends early", payload.size());
  if (!valid) return fail(ErrorCode::kInvalidStream, "motion packet has a value out of range");
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "motion packet has excess bytes");
  reference_.last = last_of(group);
  reference_.needs_key = false;
  return group;
}

}  // namespace fbs
