// A picture is a function of (scene, state): this is the function. SPEC 10.
#pragma once

#include <optional>
#include <vector>

#include "common/picture.h"
#include "decoder/animate/projection.h"
#include "decoder/raster/rasteriser.h"

namespace fbs {

/// A decoded picture of the person and where everything lay in it.
struct Pattern {
  Picture picture;
  ScreenMesh seen;  ///< texture coordinates; empty without a face
};

/// All that the pictures of a stream share until the next setup packet.
struct Scene {
  Setup setup;
  std::optional<SceneGeometry> geometry;  ///< absent: pattern 0 is shown as it is
  std::vector<Pattern> patterns;          ///< at least one once pictures are drawn
};

/// Draws pictures of a scene. Keeps scratch memory only: what it draws depends on its arguments alone.
class Renderer {
 public:
  /// Draws the picture of `state` into `out`, which takes the size of the scene.
  void render(const Scene& scene, const State& state, Picture& out);

 private:
  DepthPlane luma_depth_, chroma_depth_;
};

}  // namespace fbs
