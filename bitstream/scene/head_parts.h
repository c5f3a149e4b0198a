// The head of a scene in parts, for those who join it: an erasure code. SPEC 4.12, 6.5.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/syntax.h"

namespace fbs {

/// One symbol of a head: a Reed-Solomon code over GF(256), as in RFC 5510. Any `symbols` of them with
/// different indices determine the head.
/// @param head   1..kMaxHead bytes
/// @param symbols  1..kMaxHeadSymbols
/// @param index  0..kMaxHeadParts - 1
[[nodiscard]] std::vector<std::uint8_t> head_symbol(std::span<const std::uint8_t> head, int symbols,
                                                    int index);

/// Collects parts of one head.
class HeadParts {
 public:
  /// Adds a part; one of another head takes the place of those before it.
  /// @return the head, once there are enough
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> add(HeadPart part);

 private:
  std::vector<HeadPart> parts_;  ///< of the same head, with different indices
};

}  // namespace fbs
