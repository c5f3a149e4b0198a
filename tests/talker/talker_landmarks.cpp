// The 68 landmarks of talker_head.h: their rest positions, computed once, and how they move.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/talker/talker_head.h"

namespace fbs::talker {
namespace {

using Points = std::array<glm::vec3, kLandmarkTotal>;

glm::vec3 on_face(float x, float y) {
  return {x, y, front_z(x, y)};
}

/// Is any of the skull straight behind (x, y) of the picture plane?
bool covered(float x, float y) {
  for (float z = -1.6f; z < 1.6f; z += 0.02f) {
    if (skull_distance({x, y, z}) < 0) return true;
  }
  return false;
}

/// The border of the face in direction `angle` from the middle of the face; slightly inside, where the
/// surface stays visible when the head turns a few degrees.
glm::vec3 border(float angle) {
  constexpr float kCentreY = 0.20f, kInside = 0.965f;
  const float cx = -std::cos(angle), cy = std::sin(angle);
  float in = 0.3f, out = 3.0f;
  for (int i = 0; i < 24; ++i) {
    const float middle = 0.5f * (in + out);
    (covered(cx * middle, kCentreY + cy * middle) ? in : out) = middle;
  }
  return on_face(cx * in * kInside, kCentreY + cy * in * kInside);
}

/// Neutral positions of the points that are skin; lids are left out (they slide).
Points rest_points() {
  Points p{};
  constexpr float kAboveMiddle = 0.19f;  // the ends of the jaw lie at the height of the eyes
  for (int i = 0; i <= 16; ++i) {
    const float along = static_cast<float>(i) / 16.0f;
    p[i] = border(along * (std::numbers::pi_v<float> + 2 * kAboveMiddle) - kAboveMiddle);
  }
  for (int i = 0; i < 5; ++i) {
    const float u = 0.03f + 0.94f * static_cast<float>(i) / 4.0f;
    const float x = kBrowInnerX + (kBrowOuterX - kBrowInnerX) * u;
    const float y = brow_line(u).y - brow_line(u).half_thickness;  // the upper border, as iBUG marks it
    p[21 - i] = on_face(-x, y);
    p[22 + i] = on_face(x, y);
  }
  constexpr std::array<float, 4> kBridgeY{0.02f, 0.20f, 0.37f, 0.54f};
  for (int i = 0; i < 4; ++i) p[27 + i] = on_face(0, kBridgeY[i]);
  constexpr std::array<float, 5> kBaseX{-0.22f, -0.11f, 0, 0.11f, 0.22f};
  constexpr std::array<float, 5> kBaseY{0.69f, 0.725f, 0.745f, 0.725f, 0.69f};
  for (int i = 0; i < 5; ++i) p[31 + i] = on_face(kBaseX[i], kBaseY[i]);

  const auto lip = [](float u, float offset) { return on_face(u * kMouthHalfWidth, lip_line(u) + offset); };
  constexpr std::array<float, 7> kOuterU{-1.0f, -0.60f, -0.22f, 0, 0.22f, 0.60f, 1.0f};
  for (int i = 0; i < 7; ++i) p[48 + i] = lip(kOuterU[i], -upper_lip(kOuterU[i]));
  for (int i = 0; i < 5; ++i) p[55 + i] = lip(kOuterU[5 - i], lower_lip(kOuterU[5 - i]));
  constexpr std::array<float, 5> kInnerU{-0.95f, -0.40f, 0, 0.40f, 0.95f};
  for (int i = 0; i < 5; ++i) p[60 + i] = lip(kInnerU[i], 0);
  for (int i = 0; i < 3; ++i) p[65 + i] = lip(kInnerU[3 - i], 0);
  return p;
}

/// Point of a lid's edge; side as in eyeball_centre, u as in lid_edges.
glm::vec3 lid_point(int side, float u, float open, bool upper) {
  const LidEdges edges = lid_edges(u, open);
  return on_face(static_cast<float>(side) * (kEyeX + u * kEyeHalfWidth), upper ? edges.upper : edges.lower);
}

}  // namespace

std::array<glm::vec3, kLandmarkTotal> landmarks(const Expression& e) {
  static const Points rest = rest_points();
  Points p = rest;
  constexpr float kThird = 1.0f / 3.0f;
  const float right = e.eye_open_right, left = e.eye_open_left;
  p[36] = lid_point(-1, 1, right, true);
  p[37] = lid_point(-1, kThird, right, true);
  p[38] = lid_point(-1, -kThird, right, true);
  p[39] = lid_point(-1, -1, right, true);
  p[40] = lid_point(-1, -kThird, right, false);
  p[41] = lid_point(-1, kThird, right, false);
  p[42] = lid_point(1, -1, left, true);
  p[43] = lid_point(1, -kThird, left, true);
  p[44] = lid_point(1, kThird, left, true);
  p[45] = lid_point(1, 1, left, true);
  p[46] = lid_point(1, kThird, left, false);
  p[47] = lid_point(1, -kThird, left, false);

  for (int i = 0; i < kLandmarkTotal; ++i) {
    const int lip = i >= 60 && i <= 64 ? -1 : i >= 65 ? 1 : 0;
    p[i] = moved(p[i], e, lip);
  }
  return p;
}

}  // namespace fbs::talker
