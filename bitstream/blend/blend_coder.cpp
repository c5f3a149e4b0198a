#include "bitstream/blend/blend_coder.h"

#include <algorithm>
#include <utility>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

bool in_range(const RegionModes& modes) {
  return std::all_of(modes.begin(), modes.end(),
                     [](BlendMode m) { return static_cast<int>(m) < kBlendModeCount; });
}

const BlendMemory& before_a_scene() {
  static const auto memory = trained<BlendMemory>(trained_blends());
  return memory;
}

}  // namespace

Result<std::vector<std::uint8_t>> BlendEncoder::encode(const BlendGroup& group) {
  if (group.modes.empty() || group.modes.size() > kMaxGroupPictures)
    return fail(ErrorCode::kInvalidArgument, "a blend group has 1 to 256 pictures");
  if (needs_key_ && !group.key)
    return fail(ErrorCode::kInvalidArgument, "the first blend group must be a key group");
  if (!std::all_of(group.modes.begin(), group.modes.end(), in_range))
    return fail(ErrorCode::kInvalidArgument, "a blend mode is out of range");
  if (group.key) memory_ = before_a_scene();
  RangeEncoder encoder;
  encoder.raw_bit(kNotKey, group.key);
  code_blend(encoder, memory_, group);
  needs_key_ = false;
  return encoder.finish();
}

Result<BlendGroup> BlendDecoder::decode(std::span<const std::uint8_t> payload) {
  const bool needed_key = std::exchange(needs_key_, true);  // until the whole group has been read
  RangeDecoder decoder(payload);
  BlendGroup group;
  group.key = decoder.raw_bit(kNotKey);
  if (needed_key && !group.key)
    return fail(ErrorCode::kInvalidStream, "blend packet depends on a missing one");
  if (group.key) memory_ = before_a_scene();
  const bool valid = code_blend(decoder, memory_, group);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "blend packet ends early", payload.size());
  if (!valid) return fail(ErrorCode::kInvalidStream, "blend packet has a value out of range");
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "blend packet has excess bytes");
  needs_key_ = false;
  return group;
}

}  // namespace fbs
