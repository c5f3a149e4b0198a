// Chooses how the picture round the face moves: the surround's map. Design section 4.
#pragma once

#include "bitstream/syntax.h"
#include "encoder/surround/surround_observations.h"

namespace fbs {

/// For each point of the grid, which shares in the motions of head, body and ground explain the later
/// pictures best: the sum over the grid's cells of the truncated squared differences that moving the first
/// picture's luma leaves where the head does not hide it (CellCost), smoothed so that neighbours agree, and
/// from the spatial prior where the pictures show nothing (MapLabelling).
/// @param observations  with a first picture; without later ones the spatial prior alone decides
[[nodiscard]] SurroundMap fit_surround(const Setup& setup, const Geometry& geometry,
                                       const SurroundObservations& observations);

}  // namespace fbs
