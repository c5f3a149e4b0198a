// Blend packets: how pictures are blended from patterns. SPEC 4.6.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/blend/blend_syntax.h"
#include "bitstream/entropy/range_coder.h"
#include "common/result.h"

namespace fbs {

/// Writes the blend packets of one scene, in stream order. A value: a copy continues independently.
class BlendEncoder {
 public:
  /// Codes the next group.
  /// @return kInvalidArgument  a number of pictures outside 1..kMaxGroupPictures; not a key group where one
  ///                           is needed; another first picture than next(); a mode out of range. The encoder
  ///                           is then unchanged.
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode(const BlendGroup& group);
  /// The same for a unit, whose motion says which pictures they are and whether they are key.
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode_in_unit(const BlendGroup& group);

  /// Groups coded so far. The first is a key group.
  [[nodiscard]] int groups() const { return groups_; }
  /// Number of the first picture of the next group.
  [[nodiscard]] std::int32_t next() const { return next_; }

 private:
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode(const BlendGroup& group, bool in_unit);

  BlendMemory memory_;
  std::int32_t next_ = 0;
  int groups_ = 0;
};

/// Reads the blend packets of one scene. Some may be missing; what comes twice or too late is skipped.
class BlendDecoder {
 public:
  /// @param next  number of the first picture that is to come
  explicit BlendDecoder(std::int32_t next = 0) { order_.next = next; }

  /// Reads the next group. After an error or a missing group only a key group can be read.
  /// @return nothing if the group has come before, or needs one that is missing; kTruncated, kInvalidStream
  [[nodiscard]] Result<std::optional<BlendGroup>> decode(std::span<const std::uint8_t> payload);
  /// The same for what encode_in_unit() has written.
  /// @param motion  of the unit
  [[nodiscard]] Result<std::optional<BlendGroup>> decode_in_unit(std::span<const std::uint8_t> code,
                                                                 const MotionGroup& motion);

  /// True before the first group, after an error and after a missing group.
  [[nodiscard]] bool needs_key() const { return order_.needs_key; }

 private:
  /// @param pictures  of the group; 0: the code says
  [[nodiscard]] Result<std::optional<BlendGroup>> decode(RangeDecoder& decoder, BlendGroup group,
                                                         std::int32_t pictures);

  BlendMemory memory_;
  GroupOrder order_;
};

/// The payload of a unit.
/// @param motion  payload of a motion packet
/// @param blend   from BlendEncoder::encode_in_unit()
[[nodiscard]] std::vector<std::uint8_t> unit_payload(std::span<const std::uint8_t> motion,
                                                     std::span<const std::uint8_t> blend);

}  // namespace fbs
