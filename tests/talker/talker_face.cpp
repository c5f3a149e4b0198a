#include "tests/talker/talker_face.h"

#include <cmath>

#include "tests/talker/talker_noise.h"

namespace fbs::talker {
namespace {

/// The skin of the front; the back of the head does not move.
float front(float z) {
  return 1.0f - smooth_step(-0.75f, 0.0f, z);
}

/// Sideways motion of the lips: 1 at the corners, fading over cheeks, nose and chin.
float mouth_stretch(glm::vec3 p, const Expression& e) {
  if (e.mouth_wide == 0) return 0;
  const float k = 1.0f - kMouthHalfWidth / (kMouthHalfWidth + e.mouth_wide);
  return k * p.x *
         bell(square((p.y - kMouthY) / 0.36f) + square(std::max(0.0f, std::abs(p.x) - 0.45f) / 0.22f));
}

/// How far the skin at x goes down with the jaw when it is rigid: all in front, nothing at the hinge.
float jaw_share(glm::vec3 p) {
  return front(p.z) * (1.0f - smooth_step(0.55f, 1.25f, std::abs(p.x)));
}

/// Vertical motion around the mouth at (x, y), x already unstretched.
float mouth_drop(float x, glm::vec3 p, const Expression& e) {
  if (e.mouth_open <= 0 || p.y < 0.4f) return 0;
  const float u = x / kMouthHalfWidth;
  const float gap = lip_gap(u, e.mouth_open);
  const float upper = lip_line(u) - kUpperLipShare * gap;
  const float lower = upper + gap;
  if (p.y <= upper) return -kUpperLipShare * gap * bell(square((p.y - upper) / 0.3f));
  const float below = (1.0f - kUpperLipShare) * gap;
  if (p.y < lower) return p.y - lip_line(u);
  const float jaw = 0.8f * e.mouth_open * jaw_share(p);
  return below + (jaw - below) * smooth_step(0.0f, 0.75f, p.y - lower);
}

float brow_raise(glm::vec3 p, const Expression& e) {
  const auto lift = [&](float side, float height) {
    if (height == 0) return 0.0f;
    const float dy = p.y + 0.40f;
    return -height * bell(square((p.x - side * 0.52f) / 0.42f) + square(dy / (dy > 0 ? 0.24f : 0.42f)));
  };
  return (lift(-1, e.brow_right) + lift(1, e.brow_left)) * front(p.z);
}

}  // namespace

float upper_lip(float u) {
  const float k = std::max(0.0f, 1.0f - u * u);
  const float bow = 1.0f - 0.22f * bell(square(u / 0.16f));
  return 0.115f * std::pow(k, 0.85f) * bow;
}

float lower_lip(float u) {
  const float k = std::max(0.0f, 1.0f - u * u);
  return 0.145f * std::pow(k, 0.7f);
}

LidEdges lid_edges(float u, float open) {
  const float k = std::max(0.0f, 1.0f - u * u);
  const float corner = -0.012f * (u + 1.0f);  // the outer corner is higher
  constexpr float kClosedY = 0.055f;
  const float shut = corner + kClosedY * k;
  const float round = std::pow(k, 0.8f);
  return {shut - open * round * (1.0f - 0.06f * u), shut};
}

BrowLine brow_line(float u) {
  const float arch = 4.0f * u * (1.0f - u);
  return {-0.335f - 0.015f * u - 0.050f * arch + 0.06f * u * u * u,
          0.042f * std::sqrt(std::max(0.0f, 1.0f - 0.8f * u)) * smooth_step(-0.06f, 0.1f, u)};
}

glm::vec3 rest_of(glm::vec3 p, const Expression& e) {
  if (p.z > 0) return p;  // the back of the head does not move
  const float x = p.x - mouth_stretch(p, e);
  const float y = p.y - mouth_drop(x, p, e) - brow_raise(p, e);
  if (e.mouth_round == 0) return {x, y, p.z};
  const float forward = e.mouth_round * bell(p.x, p.y, 0, kMouthY, 0.42f, 0.34f) * front(p.z);
  return {x, y, p.z + forward};
}

glm::vec3 moved(glm::vec3 rest, const Expression& e, int lip) {
  glm::vec3 p = rest;
  for (int i = 0; i < 60; ++i) {
    glm::vec3 d = p - rest_of(p, e);
    if (lip != 0) {
      const float gap = lip_gap(rest.x / kMouthHalfWidth, e.mouth_open);
      d.y = lip < 0 ? -kUpperLipShare * gap : (1.0f - kUpperLipShare) * gap;
    }
    p = rest + d;
  }
  return p;
}

MouthPlace mouth_place(glm::vec3 p, const Expression& e) {
  const float u = (p.x - mouth_stretch(p, e)) / kMouthHalfWidth;
  const float upper = lip_line(u) - kUpperLipShare * lip_gap(u, e.mouth_open);
  return {u, upper, upper + lip_gap(u, e.mouth_open)};
}

}  // namespace fbs::talker
