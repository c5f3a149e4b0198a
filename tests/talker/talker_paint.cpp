#include "tests/talker/talker_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "tests/talker/talker_eye.h"
#include "tests/talker/talker_mouth.h"
#include "tests/talker/talker_noise.h"

namespace fbs::talker {
namespace {

/// Display values 0..255 to linear light, gamma 2.
constexpr glm::vec3 rgb(int r, int g, int b) {
  const glm::vec3 c{static_cast<float>(r) / 255.0f, static_cast<float>(g) / 255.0f,
                    static_cast<float>(b) / 255.0f};
  return c * c;
}

/// Freckles and moles: few, fixed to the skin.
float moles(glm::vec3 q, const Look& look) {
  float dark = 0;
  for (std::uint32_t i = 0; i < 9; ++i) {
    const float x = 1.5f * hash01(i, 1, look.seed) - 0.75f, y = 2.6f * hash01(i, 2, look.seed) - 0.9f;
    const float radius = 0.014f + 0.016f * hash01(i, 3, look.seed);
    dark = std::max(dark, bell(q.x, q.y, x, y, radius, radius) * (0.2f + 0.35f * hash01(i, 4, look.seed)));
  }
  return dark;
}

Material paint_skin(glm::vec3 q, const Look& look, float pixels) {
  const float x = std::abs(q.x), y = q.y;
  const float blush = 0.55f * bell(x, y, 0.66f, 0.60f, 0.34f, 0.26f) +
                      0.4f * bell(x, y, 0, 0.55f, 0.2f, 0.16f) + 0.25f * bell(x, y, 0, 1.62f, 0.3f, 0.2f) +
                      0.5f * smooth_step(1.0f, 1.2f, x) * bell(square((y - 0.27f) / 0.4f));
  Material m;
  m.albedo = glm::mix(look.skin, look.blush, std::min(blush, 1.0f));
  const float blotches = texture_noise(q, 3.5f, 2, pixels, look.seed + 11);
  const float pores = texture_noise(q, 11.0f, 4, pixels, look.seed + 12);
  m.albedo *= (1.0f + 0.07f * blotches + 0.10f * pores) * glm::vec3(1.0f, 1.0f + 0.03f * blotches, 1.0f);
  m.albedo *= 1.0f - moles(q, look);

  float shade = 0;
  shade += 0.30f * bell(x, y, 0.27f, -0.06f, 0.13f, 0.18f);                      // between eye and nose
  shade += 0.16f * bell(x, y, 0.50f, -0.15f, 0.26f, 0.09f);                      // over the lid
  shade += 0.14f * bell(x, y, 0.44f, 0.21f, 0.22f, 0.06f);                       // under the eye
  shade += 0.22f * bell(x, y, 0, 0.79f, 0.22f, 0.09f);                           // under the nose
  shade += 0.20f * bell(x, y, 0, 1.33f, 0.26f, 0.07f);                           // under the lip
  shade += 0.12f * bell(x - 0.35f * (y - 0.7f), y, 0.30f, 0.86f, 0.05f, 0.22f);  // beside the mouth
  shade += 0.45f * bell(x, y, 1.13f, 0.27f, 0.09f, 0.2f) * smooth_step(-0.05f, 0.1f, q.z);  // in the ear
  shade += 0.35f * smooth_step(-0.14f, 0.0f, hair_depth(q));                                // under the hair
  m.occlusion = 1.0f - std::min(shade, 0.8f);

  const float tilt = (x - 0.105f) * 0.35f;
  const float nostril = bell(x, y, 0.105f, 0.695f - tilt, 0.055f, 0.026f);
  m.albedo = glm::mix(m.albedo, look.lips * 0.08f, std::min(1.0f, 1.3f * nostril));
  m.gloss = 0.10f * (1.0f + 0.5f * pores);
  m.shininess = 14;
  return m;
}

void paint_brows(Material& m, glm::vec3 q, const Look& look, float pixels) {
  const float u = (std::abs(q.x) - kBrowInnerX) / (kBrowOuterX - kBrowInnerX);
  if (u < -0.1f || u > 1.1f || q.y > 0 || q.z > 0) return;
  const BrowLine line = brow_line(std::clamp(u, 0.0f, 1.0f));
  const float across = (q.y - line.y) / (line.half_thickness + 0.012f);
  if (std::abs(across) > 2) return;
  // Strokes lean outwards: constant along lines that rise to the outside.
  const float stroke = std::abs(q.x) * 26.0f + q.y * 20.0f;
  const float hairs = texture_noise({stroke / 12.0f, q.y * 0.6f, q.x < 0 ? 1.0f : 2.0f}, 12.0f, 2,
                                    pixels * 0.4f, look.seed + 21);
  const float ends = smooth_step(-0.05f, 0.06f, u) * (1.0f - smooth_step(0.9f, 1.03f, u));
  const float cover = ends * (1.0f - smooth_step(0.55f, 1.35f, std::abs(across) + 0.20f * hairs));
  m.albedo = glm::mix(m.albedo, look.brow * (1.0f + 0.5f * hairs), 0.9f * cover);
  m.gloss *= 1.0f - cover;
}

void paint_hair(Material& m, glm::vec3 q, const Look& look, float pixels) {
  const float depth = hair_depth(q);
  if (depth < -0.15f) return;
  const float waves = 0.05f * value_noise(q * 2.5f, look.seed + 31);
  const float in_front = 1.0f - smooth_step(-1.2f, -0.4f, q.z);
  const float across =
      q.z - 0.60f * q.y + 0.45f * in_front * std::abs(q.x + 0.35f) + waves + (q.x < -0.35f ? 7.0f : 0.0f);
  const float along = std::abs(q.x + 0.35f) + 0.5f * q.y;
  const glm::vec3 strand{across, along * 0.12f, 0.1f * q.x};
  const float fine = texture_noise(strand, 13.0f, 4, pixels, look.seed + 32);
  const float locks = texture_noise(strand, 4.0f, 2, pixels, look.seed + 33);
  const float cover = smooth_step(-0.03f, 0.07f, depth + 0.05f * fine + 0.02f * locks);
  const float parting = bell(square((q.x + 0.35f + waves) / 0.035f)) * smooth_step(-0.9f, -1.2f, q.y);
  const glm::vec3 colour = look.hair * (1.0f + 0.60f * fine + 0.65f * locks) * (1.0f - 0.6f * parting);
  m.albedo = glm::mix(m.albedo, glm::max(colour, glm::vec3(0.002f)), cover);
  m.occlusion = glm::mix(m.occlusion, 0.85f + 0.15f * smooth_step(0.0f, 0.4f, depth), cover);
  m.gloss = glm::mix(m.gloss, 0.05f * (1.0f + 1.2f * fine + locks), cover);
  m.shininess = glm::mix(m.shininess, 7.0f, cover);
}

}  // namespace

Look look_of(std::uint32_t seed) {
  Look a{.skin = rgb(226, 178, 150),
         .blush = rgb(222, 140, 120),
         .lips = rgb(186, 88, 86),
         .hair = rgb(74, 50, 36),
         .brow = rgb(58, 40, 30),
         .iris = rgb(96, 112, 104),
         .jacket = rgb(58, 74, 104),
         .shirt = rgb(226, 224, 216),
         .wall = rgb(150, 152, 140),
         .seed = seed};
  switch (seed % 4) {
    case 2:  // dark skin, black hair
      a.skin = rgb(150, 102, 76), a.blush = rgb(146, 84, 66), a.lips = rgb(128, 62, 58),
      a.hair = rgb(36, 29, 27);
      a.brow = rgb(26, 20, 18), a.iris = rgb(70, 46, 30), a.jacket = rgb(150, 60, 58),
      a.wall = rgb(118, 140, 150);
      break;
    case 3:  // light skin, reddish hair
      a.skin = rgb(238, 198, 176), a.blush = rgb(236, 160, 144), a.lips = rgb(196, 96, 96),
      a.hair = rgb(132, 74, 42);
      a.brow = rgb(104, 60, 38), a.iris = rgb(84, 118, 140), a.jacket = rgb(70, 96, 76),
      a.wall = rgb(132, 128, 138);
      break;
    case 0:  // olive skin, black hair
      a.skin = rgb(206, 158, 122), a.blush = rgb(200, 126, 98), a.lips = rgb(168, 80, 74),
      a.hair = rgb(46, 37, 33);
      a.brow = rgb(36, 28, 25), a.iris = rgb(86, 60, 40), a.jacket = rgb(92, 88, 92),
      a.wall = rgb(156, 140, 120);
      break;
    default:
      break;
  }
  return a;
}

float texture_noise(glm::vec3 p, float frequency, int octaves, float pixels_per_unit, std::uint32_t seed) {
  float sum = 0, weight = 1;
  for (int i = 0; i < octaves; ++i) {
    const float pixels_per_lump = pixels_per_unit / frequency;
    const float shown = smooth_step(0.9f, 2.2f, pixels_per_lump);
    if (shown <= 0) break;
    sum += weight * shown * value_noise(p * frequency, seed + static_cast<std::uint32_t>(i));
    weight *= 0.75f;
    frequency *= 2.0f;
  }
  return sum;
}

Material paint(const SurfacePoint& point, const Expression& e, const Look& look, const Arrival& arrival) {
  const glm::vec3 q = point.rest;
  const bool is_front = q.z < -0.3f;
  if (is_front) {
    if (const auto inside = paint_mouth_inside(point.position, e, look, arrival)) return *inside;
    if (const auto eye = paint_eyeball(q, e, look, arrival)) return *eye;
  }
  constexpr float kCovered = 0.25f;  // so deep in the hair no skin is seen
  Material m;
  if (hair_depth(q) < kCovered) m = paint_skin(q, look, arrival.pixels_per_unit);
  if (is_front) {
    paint_lids(m, q, e, look);
    paint_lips(m, q, e, look, arrival.pixels_per_unit);
    paint_brows(m, q, look, arrival.pixels_per_unit);
  }
  paint_hair(m, q, look, arrival.pixels_per_unit);
  return m;
}

}  // namespace fbs::talker
