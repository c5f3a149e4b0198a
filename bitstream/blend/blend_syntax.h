// The layout of a blend packet, described once for writing and reading. SPEC 4.6.
//
// Coder is RangeEncoder or RangeDecoder; Group is BlendGroup for the one that reads and const BlendGroup for
// the other.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "bitstream/entropy/adaptive_bit.h"
#include "bitstream/entropy/trained_contexts.h"
#include "bitstream/group_number.h"
#include "bitstream/syntax.h"

namespace fbs {

/// What adapts from group to group of a scene.
struct BlendMemory {
  AdaptiveBit other_count;
  std::int32_t pictures = 0;  ///< of the last group
  RegionModes last{};         ///< of the last picture
  /// By whether the picture is the first of a key group, by region, and by how many of the regions before it
  /// have changed in this picture: none, one, more.
  std::array<std::array<std::array<AdaptiveBit, 3>, kRegionCount>, 2> changed;
  /// Modes as a binary tree of four levels, for the head's regions and for the others.
  std::array<std::array<AdaptiveBit, 16>, 2> tree;
};

/// Calls f(context) for each context, in the order of SPEC 4.6.
template <class F>
void for_each_context(BlendMemory& memory, F&& f) {
  f(memory.other_count);
  for_each_context(memory.changed, f);
  for_each_context(memory.tree, f);
}

inline constexpr int kModeBits = 4;
static_assert(kBlendModeCount <= 1 << kModeBits);

/// Codes the mode of a region in a picture.
/// @param changed  contexts of the region
/// @return false when what was read is not a mode
template <class Coder>
bool code_mode(Coder& coder, BlendMemory& memory, std::array<AdaptiveBit, 3>& changed, std::size_t region,
               int changes, BlendMode& mode) {
  if (!coder.bit(changed[std::min(changes, 2)], mode != memory.last[region])) {
    if constexpr (Coder::kReads) mode = memory.last[region];
    return true;
  }
  auto& tree = memory.tree[region < static_cast<std::size_t>(Region::kBody) ? 0 : 1];
  unsigned node = 1;
  for (int bit = kModeBits - 1; bit >= 0; --bit)
    node = node << 1 | unsigned{coder.bit(tree[node], (static_cast<unsigned>(mode) >> bit & 1) != 0)};
  const unsigned value = node & ((1u << kModeBits) - 1);
  if constexpr (Coder::kReads) mode = static_cast<BlendMode>(value);
  return value < static_cast<unsigned>(kBlendModeCount);
}

/// Codes the number of pictures.
/// @return it; 0 for that of the group before if there was none
template <class Coder>
std::int32_t code_count(Coder& coder, BlendMemory& memory, std::int32_t pictures) {
  static_assert(kMaxGroupPictures == 1 << 8);
  if (coder.bit(memory.other_count, pictures != memory.pictures))
    memory.pictures =
        static_cast<std::int32_t>(coder.bypass(8, static_cast<std::uint32_t>(pictures - 1))) + 1;
  return memory.pictures;
}

/// Codes the modes of a group, which has as many as pictures.
/// @return false when what was read is out of range or ends early
template <class Coder, class Group>
bool code_modes(Coder& coder, BlendMemory& memory, Group& group) {
  for (auto& modes : group.modes) {
    const bool first = group.key && group.first > 0 && &modes == group.modes.data();
    int changes = 0;
    for (std::size_t region = 0; region < kRegionCount; ++region) {
      BlendMode mode = modes[region];
      if (!code_mode(coder, memory, memory.changed[first ? 1 : 0][region], region, changes, mode))
        return false;
      if (mode != memory.last[region]) ++changes;
      memory.last[region] = mode;
      if constexpr (Coder::kReads) modes[region] = mode;
    }
    if constexpr (Coder::kReads) {
      if (!coder.ok()) return false;
    }
  }
  return true;
}

}  // namespace fbs
