// Optical flow of the mesh from picture to picture, and the pose that explains it: the tracker's first guess.
#pragma once

#include <array>

#include "encoder/image/work_frame.h"
#include "encoder/model/surface.h"

namespace fbs {

/// Position of each vertex after the flow, pixels of the picture; nan where it was lost.
using MeshFlow = std::array<glm::dvec2, kVertexCount>;

/// Pyramidal Lucas-Kanade flow of the vertices from their positions in `before`.
[[nodiscard]] MeshFlow mesh_flow(const WorkFrame& before, const WorkFrame& now, const Pose& pose,
                                 const HeadVertices& vertices);

/// Robust fit of the pose to the flow (Geman-McClure with an outlier scale that narrows).
[[nodiscard]] Pose fit_pose(const MeshFlow& flow, const Pose& start, const HeadVertices& vertices);

}  // namespace fbs
