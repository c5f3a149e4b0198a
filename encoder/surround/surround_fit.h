// Chooses how the picture around the face moves: the surround's map.
#pragma once

#include "bitstream/syntax.h"
#include "encoder/surround/surround_observations.h"

namespace fbs {

/// Chooses for each point of the grid the shares in the motions of head, body and ground that best explain
/// the later pictures. Minimises the sum over the grid's cells of the truncated squared differences that
/// remain after moving the first picture's luma where the head does not hide it (CellCost), smoothed so that
/// neighbours agree, and following the spatial prior where the pictures show nothing (MapLabelling).
/// @param observations  with a first picture; without later ones the spatial prior alone decides
[[nodiscard]] SurroundMap fit_surround(const Setup& setup, const Geometry& geometry,
                                       const SurroundObservations& observations);

}  // namespace fbs
