// What the pictures between two setup packets are drawn from.
#pragma once

#include <optional>

#include "decoder/animate/scene_geometry.h"
#include "decoder/scene/pattern.h"

namespace fbs {

/// What pictures share until the next setup packet.
struct Scene {
  Setup setup;
  std::optional<SceneGeometry> geometry;  ///< absent: patterns are shown as they are
  PatternList patterns;                   ///< by rising slot; at least one once pictures are drawn

  /// Replaces the geometry; texture meshes of the patterns follow.
  void set_geometry(SceneGeometry replacement);
};

}  // namespace fbs
