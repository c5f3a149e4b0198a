// Chooses how the picture round the face moves: the surround's map. Design section 4.
#pragma once

#include <span>

#include "bitstream/syntax.h"
#include "common/picture.h"

namespace fbs {

/// A picture of the scene and the state that was found for it, body and ground included.
struct SeenPicture {
  const Picture* picture;
  State state;
};

/// For each point of the grid, which shares in the motions of head, body and ground explain the later
/// pictures best: the sum over the grid's cells of the truncated squared differences that moving the first
/// picture's luma leaves where the head does not hide it, smoothed so that neighbours agree, and by place
/// where nothing tells. Method: iterated conditional modes (Besag 1986), first on each point's own
/// surroundings, then on the cells as they are drawn.
/// @param first   the first picture and its state
/// @param later   pictures to learn from; a dozen is enough; none: the guess by place alone
[[nodiscard]] SurroundMap fit_surround(const Setup& setup, const Geometry& geometry, const SeenPicture& first,
                                       std::span<const SeenPicture> later);

/// A map in which nothing moves.
[[nodiscard]] SurroundMap still_surround();

}  // namespace fbs
