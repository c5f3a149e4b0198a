// Memory for the samples of a source in a block.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "decoder/field/node_grid.h"

namespace fbs {

/// One plane. Wider than the block: patches are written in whole vectors, from left to right.
struct WarpedBlock {
  static constexpr std::ptrdiff_t kStride = 32;
  alignas(32) std::array<std::uint8_t, kStride * kBlockSize> samples;
};

}  // namespace fbs
