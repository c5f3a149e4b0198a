// A face in the units of fbs/fbs.h.
#pragma once

#include <optional>
#include <span>

#include "common/state.h"
#include "decoder/animate/scene_geometry.h"
#include "decoder/expression/state_edit.h"
#include "fbs/fbs.h"

namespace fbs {

[[nodiscard]] fbs_face_state face_state(const State& state);

/// The state that face_state() would describe in this way: `sent` where they agree, else with the head's
/// regions in motion.
/// @return nothing when a value is not a number, or beyond a limit of common/state.h
[[nodiscard]] std::optional<State> state_of(const fbs_face_state& face, const State& sent);

/// @return nothing when a value is not a number
[[nodiscard]] std::optional<StateEdit> edit_of(const fbs_face_edit& edit);

/// @param out  one for each vertex of the wire-frame
void write_vertices(const SceneGeometry& face, const State& state, std::span<fbs_vertex> out);

/// Confidence is also 0 where the point's triangles have no area.
void write_landmarks(const SceneGeometry& face, const State& state,
                     std::span<fbs_landmark, kLandmarkCount> out);

}  // namespace fbs
