// A face on another wire-frame. Paper section 3, Fig. 7 (d).
#pragma once

#include <memory>

#include "bitstream/syntax.h"
#include "common/result.h"
#include "common/wire_frame.h"
#include "encoder/retarget/face_stream.h"

namespace fbs {

/// Fits a wire-frame to the shape of a face: scales each axis by least squares, then deforms the frame
/// elastically (fit_elastically) until its landmarks and pupils match the face's, depth included. Other
/// vertices that both wire-frames have in the same place (those of the generic head in a subdivision of it)
/// are matched too.
/// @param frame  not null
[[nodiscard]] Geometry fit_wire_frame(const Geometry& face, std::shared_ptr<const WireFrame> frame);

/// The face with its patterns and states unchanged, on another wire-frame. Control points mean the same on
/// all wire-frames.
/// @return kTooLarge  the wire-frame or its geometry does not fit into a packet
[[nodiscard]] Result<FaceStream> on_wire_frame(FaceStream face, std::shared_ptr<const WireFrame> frame);

}  // namespace fbs
