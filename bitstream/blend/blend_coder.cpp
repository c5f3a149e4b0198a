#include "bitstream/blend/blend_coder.h"

#include <algorithm>
#include <utility>

#include "bitstream/byte_io.h"
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

/// Number of the picture behind a group.
std::int32_t behind(const BlendGroup& group) {
  return group.first + static_cast<std::int32_t>(group.modes.size());
}

}  // namespace

Result<std::vector<std::uint8_t>> BlendEncoder::encode(const BlendGroup& group) {
  return encode(group, false);
}

Result<std::vector<std::uint8_t>> BlendEncoder::encode_in_unit(const BlendGroup& group) {
  return encode(group, true);
}

Result<std::vector<std::uint8_t>> BlendEncoder::encode(const BlendGroup& group, bool in_unit) {
  if (group.modes.empty() || group.modes.size() > kMaxGroupPictures)
    return fail(ErrorCode::kInvalidArgument, "a blend group has 1 to 256 pictures");
  if (groups_ == 0 && !group.key)
    return fail(ErrorCode::kInvalidArgument, "the first blend group must be a key group");
  if (group.first != next_)
    return fail(ErrorCode::kInvalidArgument, "a blend group does not begin where the one before it ends");
  if (!std::all_of(group.modes.begin(), group.modes.end(), in_range))
    return fail(ErrorCode::kInvalidArgument, "a blend mode is out of range");
  if (group.key) memory_ = before_a_scene();
  RangeEncoder encoder;
  if (!in_unit) {
    encoder.raw_bit(kNotKey, group.key);
    code_first(encoder, group.first, next_);
    code_count(encoder, memory_, static_cast<std::int32_t>(group.modes.size()));
  }
  code_modes(encoder, memory_, group);
  next_ = behind(group);
  ++groups_;
  return encoder.finish();
}

std::vector<std::uint8_t> unit_payload(std::span<const std::uint8_t> motion,
                                       std::span<const std::uint8_t> blend) {
  std::vector<std::uint8_t> out;
  ByteWriter writer(out);
  writer.varint(motion.size());
  writer.bytes(motion);
  writer.bytes(blend);
  return out;
}

Result<std::optional<BlendGroup>> BlendDecoder::decode(std::span<const std::uint8_t> payload) {
  RangeDecoder decoder(payload);
  BlendGroup group;
  group.key = decoder.raw_bit(kNotKey);
  group.first = code_first(decoder, 0, order_.next);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "blend packet ends early", payload.size());
  if (!group.key && group.first == 0)
    return fail(ErrorCode::kInvalidStream, "the first blend packet of a scene is not key");
  return decode(decoder, std::move(group), 0);
}

Result<std::optional<BlendGroup>> BlendDecoder::decode_in_unit(std::span<const std::uint8_t> code,
                                                               const MotionGroup& motion) {
  RangeDecoder decoder(code);
  return decode(decoder, {motion.key, motion.first, 0, {}}, motion.pictures);
}

Result<std::optional<BlendGroup>> BlendDecoder::decode(RangeDecoder& decoder, BlendGroup group,
                                                       std::int32_t pictures) {
  const auto missing = order_.begin(group.key, group.first);
  if (!missing) return std::nullopt;
  group.missing = *missing;
  if (group.key) memory_ = before_a_scene();
  if (pictures == 0) pictures = code_count(decoder, memory_, 0);
  if (pictures > 0) group.modes.resize(pictures);
  const bool valid = pictures > 0 && code_modes(decoder, memory_, group);
  if (!decoder.ok()) return fail(ErrorCode::kTruncated, "blend packet ends early");
  if (!valid) return fail(ErrorCode::kInvalidStream, "blend packet has a value out of range");
  if (!decoder.at_end()) return fail(ErrorCode::kInvalidStream, "blend packet has excess bytes");
  order_.end(behind(group));
  return group;
}

}  // namespace fbs
