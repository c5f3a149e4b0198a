// How the texture of a source is displaced in the patches of a block. SPEC 10.3. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "decoder/field/node_grid.h"
#include "decoder/field/padded_plane.h"
#include "decoder/field/patch_kernels.h"

namespace fbs {

struct PatchMotion {
  enum class Kind : std::uint8_t {
    kStill,  ///< the texture's own samples
    kEven,   ///< all samples displaced alike
    kBent,   ///< linear between the nodes
  };
  Kind kind = Kind::kStill;
  PatchNodes nodes{};  ///< all the same if it is even

  [[nodiscard]] static PatchMotion between(const PatchNodes& nodes);
};

struct BlockMotion {
  /// Whether the four patches can be drawn as one.
  enum class Whole : std::uint8_t { kStill, kEven, kNo };
  Whole whole = Whole::kStill;
  std::array<PatchMotion, 4> patch{};  ///< row by row

  /// @param nodes    the displacement of the block's upper left node; the others follow, row by row
  /// @param columns  nodes in a row
  [[nodiscard]] static BlockMotion of(const glm::ivec2* nodes, int columns);
};

/// Of a chroma sample, in 1/64 of it.
[[nodiscard]] inline glm::ivec2 chroma_displacement(glm::ivec2 luma) {
  return {luma.x >> 1, luma.y >> 1};
}

/// Samples of a square that is displaced as a whole.
/// @param corner  its upper left sample
/// @param by      1/64 sample
/// @param out     memory for them; not used if none lies between samples of the texture
/// @return where they are
[[nodiscard]] SampleBlock displaced(const PaddedPlane& texture, glm::ivec2 corner, glm::ivec2 by, int size,
                                    std::uint8_t* out);

/// Draws the luma samples of a displaced patch.
/// @param corner  its upper left sample
void warp_luma(const PaddedPlane& texture, const PatchMotion& motion, glm::ivec2 corner, std::uint8_t* out);

/// Draws its samples in both chroma planes.
/// @param corner  its upper left sample in them
void warp_chroma(const PaddedPlane& u, const PaddedPlane& v, const PatchMotion& motion, glm::ivec2 corner,
                 const std::array<std::uint8_t*, 2>& out);

}  // namespace fbs
