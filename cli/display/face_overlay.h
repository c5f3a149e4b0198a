// The wire-frame and the contours of a state, drawn on its picture.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <opencv2/core.hpp>

#include "common/generic_head.h"

namespace fbs::cli {

/// Vertices as SceneGeometry::project_vertices() gives them: x, y in 1/64 pixel, z is depth.
using ScreenVertices = std::vector<glm::ivec3>;

/// Draws the edges of the mesh that no nearer triangle hides (painter's algorithm: Newell, Newell and Sancha
/// 1972, without splitting, which a face does not need).
/// @param image  BGR, `zoom` times as large as the picture
void draw_wire_frame(cv::Mat& image, const WireFrame& head, const ScreenVertices& vertices, int zoom);

/// Draws the curves of lips and brows, and both lids as one closed curve for each eye.
void draw_contours(cv::Mat& image, const WireFrame& head, const ScreenVertices& vertices, int zoom);

}  // namespace fbs::cli
