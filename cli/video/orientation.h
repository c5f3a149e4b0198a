// Turns pictures upright: phones store video in sensor orientation, with a matrix for its display.
#pragma once

#include <array>
#include <cstdint>

#include "common/picture.h"

namespace fbs {

/// One of the eight orientations of a picture: first mirrored, then, if `transposed`, rows and columns
/// swapped.
struct Orientation {
  bool flip_x = false;  ///< left and right exchanged
  bool flip_y = false;  ///< top and bottom exchanged
  bool transposed = false;
  friend bool operator==(const Orientation&, const Orientation&) = default;
};

/// Reads a display matrix as stored in containers: 3x3, rows (a b u) (c d v) (x y w), a..d in 16.16; a stored
/// point (p, q) is shown at (a p + c q, b p + d q). Angles other than quarter turns count as upright.
Orientation orientation_from_matrix(const std::array<std::int32_t, 9>& matrix);

/// @param degrees  clockwise: 0, 90, 180, 270
Orientation orientation_of_turn(int degrees);

/// The picture as displayed. With odd sides chroma may shift by half a sample, since 4:2:0 pairs pixels from
/// the top left.
Picture oriented(Picture picture, Orientation orientation);

}  // namespace fbs
