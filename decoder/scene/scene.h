// What the pictures between two setup packets are drawn from.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/picture.h"
#include "common/state.h"
#include "decoder/animate/scene_geometry.h"
#include "decoder/atlas/head_atlas.h"
#include "decoder/field/padded_plane.h"

namespace fbs {

/// A decoded picture of the person, and everything needed to draw from it.
struct Pattern {
  std::int32_t slot = 0;  ///< its place in the store
  Picture picture;
  State seen;                           ///< the state it was seen in
  TextureMesh texture;                  ///< of `seen` by the scene's geometry; empty without a face
  std::optional<PaddedPicture> padded;  ///< `picture`, to be warped; none without geometry
  HeadAtlas atlas;                      ///< the head that it shows; empty without a face

  void set_geometry(const SceneGeometry& geometry);
};

/// @param geometry  the scene's; none: a scene without a face
[[nodiscard]] Pattern make_pattern(Picture picture, const State& seen,
                                   const std::optional<SceneGeometry>& geometry);

/// The same from a coded picture, which has the setup's contrast.
[[nodiscard]] Pattern make_coded_pattern(Picture coded, const State& seen,
                                         const std::optional<SceneGeometry>& geometry, const Setup& setup);

/// What pictures share until the next setup packet.
struct Scene {
  Setup setup;
  std::optional<SceneGeometry> geometry;  ///< absent: patterns are shown as they are
  std::vector<Pattern> patterns;          ///< by rising slot; at least one once pictures are drawn

  /// Puts a pattern into the store, in the place of one with the same slot.
  void store(Pattern pattern);

  /// Replaces the geometry; texture meshes of the patterns follow.
  void set_geometry(SceneGeometry replacement);
};

}  // namespace fbs
