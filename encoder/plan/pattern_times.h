// Which pictures of a segment become patterns.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace fbs {

/// Consecutive pictures between two cuts.
struct Shot {
  std::size_t pictures = 0;
  bool still = false;  ///< all alike: a few patterns show them all
};

/// How many patterns the shots should have where a single moving one would have `count`: patterns serve only
/// their own shot, so that each has one at least, and each moving one after the first half a pattern more.
[[nodiscard]] std::size_t pattern_count(std::span<const Shot> shots, std::size_t count);

/// Numbers of pictures, rising, the first among them. Each shot has a pattern as long as there are enough,
/// the longest before the others; the rest are shared out by length, few of them to still shots. Within a
/// shot they are at regular distances, the first and the last picture among them; a lone one is the shot's
/// middle, in the first shot its first.
/// @param shots  without gaps from picture 0 on; at least one, of at least one picture each
/// @param count  wanted, at least 1; as many as there are pictures at most
[[nodiscard]] std::vector<std::size_t> pattern_times(std::span<const Shot> shots, std::size_t count);

}  // namespace fbs
