#include "tests/talker/talker_head.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/talker/talker_noise.h"

namespace fbs::talker {
namespace {

/// Approximate distance to an ellipsoid; I. Quilez, "Ellipsoid - SDF": k0 (k0 - 1) / k1.
float ellipsoid(glm::vec3 p, glm::vec3 radii) {
  const glm::vec3 a = p / radii;
  const glm::vec3 b = a / radii;
  const float k0 = std::sqrt(glm::dot(a, a));
  return k0 * (k0 - 1.0f) / std::sqrt(glm::dot(b, b));
}

/// Polynomial smooth minimum; k is the width of the blend.
float smooth_min(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - h * h * k * 0.25f;
}

/// Height of the nose over the face: a ridge that rises to the tip, and two wings.
float nose(float x, float y) {
  y += 0.07f;
  if (y < -0.35f || y > 1.0f || std::abs(x) > 0.62f) return 0;
  const float ridge =
      0.05f + 0.35f * smooth_step(-0.15f, 0.70f, y) - 0.02f * bell(square((y - 0.25f) / 0.2f));
  const float profile = ridge * smooth_step(-0.35f, -0.02f, y) * (1.0f - smooth_step(0.58f, 0.86f, y));
  const float width = 0.12f + 0.08f * smooth_step(0.1f, 0.65f, y);
  return profile * bell(square(x / width)) + 0.13f * bell(x, y, -0.165f, 0.66f, 0.10f, 0.11f) +
         0.13f * bell(x, y, 0.165f, 0.66f, 0.10f, 0.11f) + 0.05f * bell(x, y, 0, 0.60f, 0.12f, 0.13f);
}

float lips(float x, float y) {
  const float u = x / kMouthHalfWidth;
  if (std::abs(u) > 1.25f || std::abs(y - kMouthY) > 0.5f) return 0;
  const float dy = y - lip_line(u);
  const float k = std::max(0.0f, 1.0f - square(u / 1.2f));
  return k * (0.055f * bell(square((dy + 0.05f) / 0.06f)) + 0.075f * bell(square((dy - 0.075f) / 0.075f))) -
         0.02f * bell(square(x / 0.05f) + square((y - 0.92f) / 0.09f));
}

/// What the face adds to the bare ellipsoids; symmetric.
float relief(glm::vec3 q) {
  const float x = std::abs(q.x), y = q.y;
  float h = nose(x, y);
  if (y < 0.42f) {
    h += 0.085f * bell(x, y, 0.42f, -0.32f, 0.40f, 0.15f);  // brow ridge
    h -= 0.17f * bell(x, y, 0.47f, 0.0f, 0.28f, 0.22f);     // socket
    h += 0.125f * bell(x, y, kEyeX, 0.0f, 0.22f, 0.17f);    // eyeball under the lids
    h -= 0.05f * bell(x, y, 1.0f, -0.35f, 0.25f, 0.40f);    // temple
  } else {
    h += lips(x, y);
    h += 0.06f * bell(x, y, 0.0f, 1.08f, 0.45f, 0.32f);   // teeth under the lips
    h -= 0.03f * bell(x, y, 0.46f, 0.95f, 0.10f, 0.28f);  // fold between cheek and mouth
    h -= 0.06f * bell(x, y, 0.0f, 1.36f, 0.30f, 0.09f);   // groove above the chin
    h += 0.09f * bell(x, y, 0.0f, 1.60f, 0.30f, 0.20f);   // chin
  }
  return h + 0.10f * bell(x, y, 0.66f, 0.50f, 0.34f, 0.30f);  // cheek bone
}

float ear(glm::vec3 q) {
  const glm::vec3 p{std::abs(q.x) - 1.13f, q.y - 0.27f, q.z - 0.10f};
  const glm::vec3 leaning{p.x - 0.25f * p.z, p.y + 0.2f * p.z, p.z};
  const float shell = ellipsoid(leaning, {0.10f, 0.36f, 0.22f});
  return shell + 0.06f * bell(square((leaning.y + 0.02f) / 0.2f) + square((leaning.z + 0.03f) / 0.11f));
}

glm::vec3 gradient(glm::vec3 p, const Expression& e) {
  constexpr float kStep = 0.012f;
  constexpr std::array<glm::vec3, 4> kTetrahedron{glm::vec3{1, -1, -1}, glm::vec3{-1, -1, 1},
                                                  glm::vec3{-1, 1, -1}, glm::vec3{1, 1, 1}};
  glm::vec3 sum{0};
  for (const glm::vec3 k : kTetrahedron) sum += k * head_distance(rest_of(p + kStep * k, e));
  return sum;
}

}  // namespace

float skull_distance(glm::vec3 q) {
  const float skull = ellipsoid(q - glm::vec3{0, -0.42f, 0.08f}, {1.10f, 1.30f, 1.36f});
  const float jaw = ellipsoid(q - glm::vec3{0, 0.72f, -0.40f}, {0.86f, 1.10f, 0.88f});
  const float head = smooth_min(skull, jaw, 0.55f);
  if (q.z > -0.2f || head > 0.6f || q.y < -1.05f) return head;
  return head - relief(q) * (1.0f - smooth_step(-0.75f, -0.2f, q.z));
}

float hair_depth(glm::vec3 q) {
  // A plane from the forehead over the temples to the nape, swept to one side of the parting.
  const float swept = 0.10f * smooth_step(-0.7f, 0.9f, q.x) - 0.05f + 0.09f * std::abs(q.x + 0.35f);
  const float plane = 0.70f * (q.z - q.y) + 0.16f + swept;
  const float sideburn = 0.10f - q.y + 0.9f * smooth_step(0.3f, 0.65f, q.z);
  return std::min(plane, sideburn);
}

float head_distance(glm::vec3 q) {
  float d = skull_distance(q);
  if (d > 0.7f) return d - 0.45f;  // far: no need for detail, and never beyond the surface
  const float depth = hair_depth(q);
  if (depth > -0.05f) {
    const float volume =
        0.24f * smooth_step(0.0f, 0.45f, depth) * (0.8f + 0.2f * smooth_step(0.3f, -1.2f, q.y));
    d -= volume;
  }
  if (std::abs(q.x) > 0.85f && std::abs(q.y - 0.27f) < 0.6f) d = smooth_min(d, ear(q), 0.06f);
  return d;
}

Trace trace(glm::vec3 origin, glm::vec3 direction, const Expression& e, std::optional<float> near) {
  const glm::vec3 o = (origin - kBoundCentre) / kBoundRadii, v = direction / kBoundRadii;
  const float vv = glm::dot(v, v), ov = glm::dot(o, v);
  const float inside = ov * ov - vv * (glm::dot(o, o) - 1.0f);
  Trace found{.point = std::nullopt, .depth = 0, .clearance = 1};
  if (inside <= 0) return found;
  const float begin = std::max(0.0f, (-ov - std::sqrt(inside)) / vv), end = (-ov + std::sqrt(inside)) / vv;

  constexpr float kClose = 0.003f, kCautious = 0.9f, kMargin = 0.05f;
  constexpr int kSteps = 40;
  float t = near ? *near - kMargin : begin;
  for (int i = 0; i < kSteps && t < end; ++i) {
    const glm::vec3 p = origin + t * direction;
    const glm::vec3 q = rest_of(p, e);
    const float d = head_distance(q);
    const bool misled = near && (d > 1.5f * kMargin || (i == 0 && d < kClose));
    if (misled) return trace(origin, direction, e);  // the surface is not where the neighbour saw it
    if (d < kClose) return {SurfacePoint{p, q}, t, 0};
    found.clearance = std::min(found.clearance, d);
    t += kCautious * d;
  }
  return found;
}

glm::vec3 normal(glm::vec3 p, const Expression& e) {
  return glm::normalize(gradient(p, e));
}

float front_z(float x, float y) {
  float z = -3.0f;
  for (int i = 0; i < 200; ++i) {
    const float d = skull_distance({x, y, z});
    if (d < 1e-5f || z > 1.0f) break;
    z += 0.5f * d;
  }
  return z;
}

glm::vec3 eyeball_centre(int side) {
  static const float z = front_z(kEyeX, 0.0f) + kEyeballRadius + 0.012f;
  return {static_cast<float>(side) * kEyeX, 0.0f, z};
}

}  // namespace fbs::talker
