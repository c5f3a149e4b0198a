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

/// Number of patterns for the shots where a single moving one would have `count`: patterns serve only their
/// own shot, so each has at least one, and each moving one after the first half a pattern more.
[[nodiscard]] std::size_t pattern_count(std::span<const Shot> shots, std::size_t count);

/// Numbers of pictures, rising, including the first. Each shot has a pattern as long as there are enough, the
/// longest first; the rest are shared out by length, few of them to still shots. Within a shot they are at
/// regular distances, including the first and the last picture; a lone one is in the shot's middle, except in
/// the first shot, where it is the first picture.
/// @param shots  without gaps from picture 0 on; at least one, of at least one picture each
/// @param count  number wanted, at least 1; limited by the number of pictures
[[nodiscard]] std::vector<std::size_t> pattern_times(std::span<const Shot> shots, std::size_t count);

}  // namespace fbs
