// The talker's expression, and the displacement field by which it moves the skin.
//
// Head frame: x right in the picture (the subject's left), y down, z away from the viewer; right-handed.
// Origin: midway between the eye centres in x and y, in the middle of the head in z.
// Unit: the eye distance. "right" and "left" in names are the subject's own.
//
// The field is Eulerian: given a point p of the moved face it says where that skin was at rest, q = p - d(p).
// Shape and paint are defined for q; landmarks need the inverse, p = q + d(p), found by iteration.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace fbs::talker {

/// All lengths in eye distances; the default is the neutral face of frame 0.
struct Expression {
  float mouth_open = 0;      ///< gap between the inner lips on the midline, 0..0.4
  float mouth_wide = 0;      ///< how far each corner moves outwards, -0.12 (rounded) .. 0.08
  float mouth_round = 0;     ///< how far the lips come forward, 0..0.1
  float eye_open_right = 0;  ///< set by neutral(): gap between the lids in the middle of the eye
  float eye_open_left = 0;
  float brow_right = 0;  ///< how far the brow is raised, 0..0.16
  float brow_left = 0;
  glm::vec2 gaze{0, 0};  ///< direction of both eyes, radians right and down
};

inline constexpr float kEyeOpenNeutral = 0.160f;  ///< gap between the lids in the middle of the eye

[[nodiscard]] inline Expression neutral() {
  Expression e;
  e.eye_open_right = e.eye_open_left = kEyeOpenNeutral;
  return e;
}

// The features at rest, seen from the front.
inline constexpr float kMouthY = 1.11f;          ///< line between the closed lips
inline constexpr float kMouthHalfWidth = 0.39f;  ///< corner to midline
inline constexpr float kEyeX = 0.5f;             ///< eye centres are (-+kEyeX, 0)
inline constexpr float kEyeHalfWidth = 0.215f;   ///< corner to eye centre
inline constexpr float kUpperLipShare = 0.2f;    ///< of the gap, the part by which the upper lip rises

/// Height of the line where closed lips meet; u = -1..1 from the right corner to the left.
[[nodiscard]] inline float lip_line(float u) {
  const float u2 = std::min(u * u, 1.3f);
  return kMouthY - 0.012f * u2 + 0.010f * (1.0f - u2);
}

/// Thickness of the lips at rest, 0 at the corners.
[[nodiscard]] float upper_lip(float u);
[[nodiscard]] float lower_lip(float u);

/// Gap between the inner lips; `open` is Expression::mouth_open.
[[nodiscard]] inline float lip_gap(float u, float open) {
  const float k = std::max(0.0f, 1.0f - u * u);
  return open * k * (1.35f - 0.35f * k);
}

/// Heights of the lid edges; u = -1..1 from the inner corner to the outer, open as in Expression.
struct LidEdges {
  float upper, lower;
};
[[nodiscard]] LidEdges lid_edges(float u, float open);

/// Height of the middle line of a brow and half its thickness; u = 0 at the inner end, 1 at the outer.
struct BrowLine {
  float y, half_thickness;
};
inline constexpr float kBrowInnerX = 0.21f, kBrowOuterX = 0.90f;
[[nodiscard]] BrowLine brow_line(float u);

/// Rest position of the skin that is at p on the moved face.
[[nodiscard]] glm::vec3 rest_of(glm::vec3 p, const Expression& e);

/// Inverse of rest_of. `lip`: -1 or +1 for a point on the edge of the upper or lower inner lip, else 0.
[[nodiscard]] glm::vec3 moved(glm::vec3 rest, const Expression& e, int lip = 0);

/// Position of p relative to the opening of the mouth.
struct MouthPlace {
  float u;      ///< -1..1 from the right corner to the left
  float upper;  ///< height of the upper lip's edge at u, eye distances
  float lower;  ///< of the lower lip's edge
};
[[nodiscard]] MouthPlace mouth_place(glm::vec3 p, const Expression& e);

}  // namespace fbs::talker
