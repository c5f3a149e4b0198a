// Blend packets: how pictures are blended from patterns. SPEC 4.6.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/blend/blend_syntax.h"
#include "common/result.h"

namespace fbs {

/// Writes the blend packets of one scene, in stream order. A value: a copy continues independently.
class BlendEncoder {
 public:
  /// Codes the next group.
  /// @return kInvalidArgument  a number of pictures outside 1..kMaxGroupPictures; not a key group where one
  ///                           is needed; a mode out of range. The encoder is then unchanged.
  [[nodiscard]] Result<std::vector<std::uint8_t>> encode(const BlendGroup& group);

  /// True before the first group.
  [[nodiscard]] bool needs_key() const { return needs_key_; }

 private:
  BlendMemory memory_;
  bool needs_key_ = true;
};

/// Reads the blend packets of one scene, in stream order.
class BlendDecoder {
 public:
  /// Reads the next group. After an error only a key group can be read.
  /// @return kTruncated, kInvalidStream
  [[nodiscard]] Result<BlendGroup> decode(std::span<const std::uint8_t> payload);

 private:
  BlendMemory memory_;
  bool needs_key_ = true;
};

}  // namespace fbs
