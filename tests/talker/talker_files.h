// Files the talker writes: Y4M pictures, truth as CSV, landmarks as JSON.
#pragma once

#include <ostream>

#include "tests/talker/talker_render.h"

namespace fbs::talker {

/// The stream header line of a clip; 4:2:0 with chroma in the middle of its four luma samples ("C420jpeg").
void write_y4m_header(std::ostream& out, const Settings& settings);

/// One picture, with its FRAME line.
void write_y4m_frame(std::ostream& out, const Picture& picture);

/// Names of the columns: frame, rx_deg (pitch), ry_deg (yaw), rz_deg (roll), tx_px, ty_px, scale (eye
/// distance in pixels when frontal), x0,y0 .. x67,y67 (pixels), mouth_open, eye_open_right, eye_open_left,
/// brow_right, brow_left (eye distances), v0 .. v67 (1 when the point is seen).
void write_truth_header(std::ostream& out);

/// The line of one frame; exact to 1e-4.
void write_truth_line(std::ostream& out, const Talker& talker, int frame);

/// {"landmarks": [[x, y], ...]}, the 68 points of a frame in pixels.
void write_marks(std::ostream& out, const Talker& talker, int frame);

}  // namespace fbs::talker
