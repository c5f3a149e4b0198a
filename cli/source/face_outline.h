// The outline of the face in a picture of a stream.
#pragma once

#include <vector>

#include "common/picture.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

struct OutlinePoint {
  int x = 0, y = 0;  ///< pixels; may lie outside the picture
  friend bool operator==(const OutlinePoint&, const OutlinePoint&) = default;
};

/// A closed polygon; empty where there is no face.
using FaceOutline = std::vector<OutlinePoint>;

/// The mesh's outline in the picture that StreamDecoder::next() announced last.
[[nodiscard]] FaceOutline face_outline(const StreamDecoder& decoder);

struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
};

/// Sets the samples inside the outline to 255 and all others to 0.
/// @return the bounding box of the outline within the plane; empty without a face in the picture
PixelBox draw_face(const FaceOutline& outline, Plane& mask);

}  // namespace fbs::cli
