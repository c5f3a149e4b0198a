// Adapts the generic head to the marked face. Paper section 2.1, Fig. 3 (c), (d).
#pragma once

#include "bitstream/syntax.h"
#include "common/result.h"
#include "encoder/find/marks.h"
#include "encoder/model/pose.h"

namespace fbs {

struct AdaptedHead {
  Geometry geometry;   ///< head units
  Pose pose;           ///< in which the marked picture shows it: no pitch; the yaw by the marks
  int iterations = 0;  ///< of the elastic process until it came to rest
};

/// Turns and scales the generic head to the marks (similarity from the eyes; then width and yaw together,
/// since what lies deep moves aside in a turn; then height), then deforms it elastically: marks attract their
/// vertices, and each force spreads over the mesh with a Gaussian of the edge distance that narrows from
/// iteration to iteration (Burr 1981, Reinders et al. 1992, as the paper cites them). Depth is scaled with
/// the mean of width and height and not deformed. The paper marks a frontal picture; ours may be turned. An
/// iteration that would turn a triangle over is shortened until it does not.
/// @return kDegenerateInput when an eye has no mark
[[nodiscard]] Result<AdaptedHead> adapt_head(const Marks& marks);

/// Shortest way along the mesh's edges between each pair of vertices, in eye distances, on the generic head.
/// Method: Floyd-Warshall. [a * kVertexCount + b]
[[nodiscard]] const std::vector<float>& edge_distances();

}  // namespace fbs
