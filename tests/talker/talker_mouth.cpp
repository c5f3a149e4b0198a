#include "tests/talker/talker_mouth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "tests/talker/talker_noise.h"

namespace fbs::talker {
namespace {

/// A row of teeth: brightness along x, darker between them and towards the sides.
float teeth_row(float x, float tooth_width) {
  const float place = std::abs(x) / tooth_width;
  const float seam = std::abs(place - std::round(place));  // 0 between two teeth
  return (0.80f + 0.20f * smooth_step(0.0f, 0.16f, seam)) *
         (1.0f - 0.85f * smooth_step(0.16f, 0.34f, std::abs(x)));
}

}  // namespace

std::optional<Material> paint_mouth_inside(glm::vec3 position, const Expression& e, const Look& look,
                                           const Arrival& arrival) {
  if (e.mouth_open <= 0 || std::abs(position.y - kMouthY) > 0.5f || std::abs(position.x) > 0.6f)
    return std::nullopt;
  const MouthPlace place = mouth_place(position, e);
  if (std::abs(place.u) >= 1 || position.y <= place.upper || position.y >= place.lower) return std::nullopt;

  // Teeth stand a little behind the lips: follow the ray to their depth.
  constexpr float kDepth = 0.09f;
  const float step = kDepth / std::max(0.3f, arrival.direction.z);
  const float x = position.x + arrival.direction.x * step, y = position.y + arrival.direction.y * step;
  const float jaw = (1.0f - kUpperLipShare) * e.mouth_open;
  const float upper_end = kMouthY + 0.022f - 0.25f * x * x;
  const float lower_end = kMouthY + jaw - 0.030f + 0.25f * x * x;

  const glm::vec3 dark{0.030f, 0.008f, 0.007f};
  const glm::vec3 ivory{0.72f, 0.68f, 0.58f};
  Material m;
  const float tongue = bell(x, y, 0, kMouthY + jaw + 0.01f, 0.26f, 0.5f * jaw + 0.02f);
  m.albedo = glm::mix(dark, look.lips * 0.55f, tongue);
  const float lower_teeth =
      smooth_step(-0.012f, 0.012f, y - lower_end) * smooth_step(0.10f, 0.2f, e.mouth_open);
  m.albedo = glm::mix(m.albedo, ivory * 0.55f, lower_teeth * teeth_row(x, 0.075f) * 0.8f);
  const float upper_teeth = 1.0f - smooth_step(-0.012f, 0.012f, y - upper_end);
  m.albedo = glm::mix(m.albedo, ivory, upper_teeth * teeth_row(x, 0.105f));
  m.occlusion = 0.45f + 0.55f * smooth_step(0.0f, 0.06f, position.y - place.upper);
  m.normal = {0, 0, -1};
  return m;
}

void paint_lips(Material& skin, glm::vec3 rest, const Expression& e, const Look& look,
                float pixels_per_unit) {
  const float u = rest.x / kMouthHalfWidth;
  if (std::abs(u) > 1.2f || std::abs(rest.y - kMouthY) > 0.35f) return;
  const float inside = std::clamp(u, -1.0f, 1.0f);
  const float dy = rest.y - lip_line(u);
  const float edge = dy < 0 ? -upper_lip(inside) : lower_lip(inside);
  const float beyond = std::abs(dy) - std::abs(edge);  // distance outside the lip
  const float ends = 1.0f - smooth_step(0.98f, 1.04f, std::abs(u));
  const float cover = ends * (1.0f - smooth_step(-0.016f, 0.010f, beyond));
  const float lines =
      texture_noise({rest.x, rest.y * 0.25f, 3.0f}, 14.0f, 3, pixels_per_unit, look.seed + 51);
  const glm::vec3 colour = look.lips * (dy < 0 ? 0.82f : 1.05f) * (1.0f + 0.12f * lines);
  skin.albedo = glm::mix(skin.albedo, colour, 0.9f * cover);
  skin.gloss = glm::mix(skin.gloss, 0.22f, cover);
  skin.shininess = glm::mix(skin.shininess, 24.0f, cover);

  const float parted = smooth_step(0.0f, 0.04f, e.mouth_open);
  const float line = bell(square(dy / 0.016f)) * (1.0f - smooth_step(0.95f, 1.12f, std::abs(u)));
  skin.albedo = glm::mix(skin.albedo, look.lips * 0.10f, (0.85f - 0.45f * parted) * line);
  const float dimple = bell(square((std::abs(u) - 1.04f) / 0.09f) + square(dy / 0.035f));
  skin.occlusion *= 1.0f - 0.4f * dimple;
}

}  // namespace fbs::talker
