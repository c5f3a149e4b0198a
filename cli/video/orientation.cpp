#include "cli/video/orientation.h"

#include <utility>

namespace fbs {
namespace {

Plane oriented(const Plane& stored, Orientation orientation) {
  Plane shown =
      orientation.transposed ? Plane(stored.height, stored.width) : Plane(stored.width, stored.height);
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      int from_x = orientation.transposed ? y : x;
      int from_y = orientation.transposed ? x : y;
      if (orientation.flip_x) from_x = stored.width - 1 - from_x;
      if (orientation.flip_y) from_y = stored.height - 1 - from_y;
      shown.row(y)[x] = stored.row(from_y)[from_x];
    }
  }
  return shown;
}

}  // namespace

Orientation orientation_from_matrix(const std::array<std::int32_t, 9>& matrix) {
  const auto [a, b, c, d] = std::array{matrix[0], matrix[1], matrix[3], matrix[4]};
  if (a != 0 && d != 0 && b == 0 && c == 0) return {a < 0, d < 0, false};
  // Shown x grows with stored q times c, shown y with stored p times b.
  if (b != 0 && c != 0 && a == 0 && d == 0) return {b < 0, c < 0, true};
  return {};
}

Orientation orientation_of_turn(int degrees) {
  return {degrees == 180 || degrees == 270, degrees == 90 || degrees == 180, degrees == 90 || degrees == 270};
}

Picture oriented(Picture picture, Orientation orientation) {
  if (orientation == Orientation{}) return picture;
  Picture shown;
  shown.y = oriented(picture.y, orientation);
  shown.u = oriented(picture.u, orientation);
  shown.v = oriented(picture.v, orientation);
  return shown;
}

}  // namespace fbs
