// How far mouth, brows and eyes have moved, and which pictures of a sequence show it best.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "common/generic_head.h"

namespace fbs::figures {

using Landmarks = std::array<glm::dvec2, kLandmarkCount>;  ///< iBUG-68, pixels

/// Measures independent of size, position and roll; eye distances.
struct FaceMotion {
  double mouth_height = 0;  ///< between the middles of the outer lips
  double brow_raise = 0;    ///< from the eyes' corners to the brows, mean of both
  double eye_open = 0;      ///< between the lids, mean of both
};

[[nodiscard]] FaceMotion face_motion(const Landmarks& points);

/// Quantile: `share` of the values that are not nan are below it.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// Pictures of one motion in which the measure rises in even steps from its low values (5 % of all are lower)
/// to its high ones (2 % are higher). Of all intervals of a second, the one closest to these steps.
/// @param measure  of each picture; nan where unknown, but not everywhere
/// @param count    at least 2, at most as many as there are pictures
[[nodiscard]] std::vector<int> rising(const std::vector<double>& measure, int count);

/// The picture with the smallest measure.
[[nodiscard]] int lowest(const std::vector<double>& measure);

}  // namespace fbs::figures
