// Whether a scene shows a face.
#pragma once

#include "bitstream/payload/geometry_payload.h"
#include "decoder/scene/scene.h"

namespace fbs {

/// The geometry of the scene's face; null where it has no face or only a flat head that moves the picture.
[[nodiscard]] inline const SceneGeometry* face_of(const Scene& scene) {
  return scene.geometry && !is_flat(scene.geometry->geometry()) ? &*scene.geometry : nullptr;
}

}  // namespace fbs
