// A face in the units of fbs/fbs.h.
#pragma once

#include <span>

#include "common/state.h"
#include "decoder/animate/scene_geometry.h"
#include "fbs/fbs.h"

namespace fbs {

[[nodiscard]] fbs_face_state face_state(const State& state);

/// @param out  as many as the wire-frame has
void write_vertices(const SceneGeometry& face, const State& state, std::span<fbs_vertex> out);

/// Confidence is 0 where the point has no triangle of any area, too.
void write_landmarks(const SceneGeometry& face, const State& state,
                     std::span<fbs_landmark, kLandmarkCount> out);

}  // namespace fbs
