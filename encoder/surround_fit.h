// Chooses how the picture round the face follows the head: the surround's map. Design section 4.
#pragma once

#include <span>

#include "bitstream/syntax.h"
#include "common/picture.h"

namespace fbs {

/// A picture of the scene and the state that was found for it.
struct SeenPicture {
  const Picture* picture;
  State state;
};

/// For each point of the grid, which share of the head's motion explains best where the first picture's
/// surroundings of that point are found in the later pictures; smoothed so that neighbours agree, and by
/// distance from the face where nothing tells. Method: iterated conditional modes (Besag 1986) on the blocks'
/// truncated squared differences.
/// @param first   the first picture and its state
/// @param later   pictures to learn from; a dozen is enough; none: the guess by distance alone
[[nodiscard]] SurroundMap fit_surround(const Setup& setup, const Geometry& geometry, const SeenPicture& first,
                                       std::span<const SeenPicture> later);

}  // namespace fbs
