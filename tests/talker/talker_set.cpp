#include "tests/talker/talker_set.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/talker/talker_noise.h"

namespace fbs::talker {
namespace {

/// Books on a board: x from the left end of the board, y up from it; picture heights.
std::optional<glm::vec3> books(glm::vec2 p, std::uint32_t seed) {
  float left = 0.01f;
  for (std::uint32_t i = 0; i < 24 && left < p.x; ++i) {
    const float width = 0.022f + 0.024f * hash01(seed, i, 1), height = 0.14f + 0.07f * hash01(seed, i, 2);
    const bool gap = hash01(seed, i, 3) < 0.12f;
    if (!gap && p.x < left + width && p.y > 0 && p.y < height) {
      const float across = (p.x - left) / width;
      const glm::vec3 cover{0.05f + 0.30f * hash01(seed, i, 4), 0.05f + 0.20f * hash01(seed, i, 5),
                            0.05f + 0.22f * hash01(seed, i, 6)};
      const float title =
          p.y > 0.6f * height && p.y < 0.8f * height && across > 0.3f && across < 0.7f ? 1.5f : 1.0f;
      return cover * (0.6f + 0.5f * bell(square((across - 0.4f) / 0.4f))) * title;
    }
    left += width + 0.001f;
  }
  return std::nullopt;
}

/// A pot plant: leaves as lenses on curved stems around (0, 0), y up; picture heights.
std::optional<glm::vec3> plant(glm::vec2 p, std::uint32_t seed) {
  std::optional<glm::vec3> colour;
  for (std::uint32_t i = 0; i < 22; ++i) {
    const float angle = -1.25f + 2.5f * hash01(seed, i, 1), reach = 0.13f + 0.28f * hash01(seed, i, 2);
    const glm::vec2 along{std::sin(angle), std::cos(angle)}, across{along.y, -along.x};
    const glm::vec2 d = p - along * reach * 0.55f;
    const float u = glm::dot(d, along) / (0.50f * reach), v = glm::dot(d, across) / (0.018f + 0.07f * reach);
    const float bend = v - 0.5f * u * u * (angle > 0 ? 1.0f : -1.0f);
    const float half = 1 - u * u;
    if (half <= 0 || std::abs(bend) > half) continue;
    const float vein = 1.0f - 0.35f * bell(square(bend / 0.12f));
    colour = glm::vec3(0.05f, 0.13f + 0.09f * hash01(seed, i, 3), 0.045f) * vein * (0.8f + 0.4f * bend);
  }
  return colour;
}

constexpr float kShoulderTop = 1.98f;  ///< where jacket and neck meet

/// Upper edge of the jacket at distance x from the middle.
float jacket_top(float x) {
  return kShoulderTop + 0.26f * std::max(0.0f, x - 0.6f) + 1.1f * square(std::max(0.0f, x - 2.2f)) -
         0.25f * std::max(0.0f, 0.6f - x);
}

float cloth(glm::vec2 p, float pixels, std::uint32_t seed) {
  const float folds = value_noise({p.x * 1.1f + 0.4f * p.y, p.y * 0.7f, 0}, seed + 61);
  const float weave = texture_noise({p.x, p.y, 0.5f}, 9.0f, 4, pixels, seed + 62);
  return 1.0f + 0.16f * folds + 0.13f * weave;
}

Material neck_skin(glm::vec2 p, float centre, float half, const BodyState& state, const Look& look) {
  const float u = std::clamp((p.x - centre) / half, -0.98f, 0.98f);
  Material m;
  const glm::vec3 skin_place{p.x - centre, p.y - state.neck_top.y, 5.0f};
  m.albedo =
      look.skin * (1.0f + 0.09f * texture_noise(skin_place, 8.0f, 4, state.pixels_per_unit, look.seed + 63));
  const float tendon = bell(square((std::abs(u) - 0.42f - 0.25f * (kShoulderTop - p.y)) / 0.09f));
  const float below_chin = p.y - state.chin.y + 0.35f * u * u;
  m.occlusion = (0.42f + 0.58f * smooth_step(0.05f, 0.75f, below_chin)) * (1.0f - 0.07f * tendon);
  m.normal = glm::normalize(glm::vec3(u, 0.15f, -std::sqrt(1.0f - u * u) - 0.15f));
  m.gloss = 0.04f;
  return m;
}

Material jacket(glm::vec2 p, float top, float lapel, const BodyState& state, const Look& look) {
  const float x = std::abs(p.x);
  Material m;
  m.albedo = look.jacket * cloth(p, state.pixels_per_unit, look.seed);
  const float roll_end = lapel + 0.30f + 0.1f * (p.y - kShoulderTop);
  const float notch = std::abs(p.y - 2.75f + 0.4f * (x - lapel));
  if (x < roll_end) m.albedo *= 1.22f;
  float seam = bell(square((x - roll_end) / 0.025f)) + bell(square((x - lapel) / 0.03f));
  if (x < roll_end && x > lapel + 0.12f) seam += bell(square(notch / 0.02f));
  seam += 0.6f * bell(square((x - 2.15f - 0.12f * (p.y - 2.4f)) / 0.03f));  // sleeve
  m.occlusion = (1.0f - 0.55f * std::min(seam, 1.0f)) * (0.6f + 0.4f * smooth_step(0.0f, 0.2f, p.y - top));
  m.normal = glm::normalize(glm::vec3(0.28f * p.x, -0.9f * bell(square((p.y - top) / 0.4f)) - 0.1f, -0.9f));
  return m;
}

Material shirt(glm::vec2 p, float collar, const BodyState& state, const Look& look) {
  Material m;
  const float stripes = 0.06f * std::sin(p.x * 42.0f) * smooth_step(18.0f, 40.0f, state.pixels_per_unit);
  m.albedo = look.shirt * (cloth(p * 1.3f, state.pixels_per_unit, look.seed + 7) + stripes) * 0.9f;
  const float button = std::abs(std::fmod(p.y - 2.0f, 0.42f) - 0.21f);
  if (std::hypot(p.x, button) < 0.032f) m.albedo *= 0.55f;
  const float placket = bell(square((std::abs(p.x) - 0.07f) / 0.012f));
  m.occlusion = (1.0f - 0.25f * placket) * (0.55f + 0.45f * smooth_step(0.0f, 0.14f, p.y - collar));
  m.normal = glm::normalize(glm::vec3(0.5f * p.x, -0.2f, -0.9f));
  return m;
}

}  // namespace

glm::vec3 background(glm::vec2 place, const Look& look, float pixels_per_height) {
  const float plaster = texture_noise({place.x, place.y, 0}, 24.0f, 4, pixels_per_height, look.seed + 71);
  const float clouds = value_noise({place.x * 3.0f, place.y * 3.0f, 1}, look.seed + 72);
  const float glow = bell(place.x, place.y, -0.35f, 0.1f, 0.7f, 0.6f);
  glm::vec3 c = look.wall * (0.50f + 0.35f * glow + 0.04f * clouds + 0.035f * plaster);

  const float from_shelf = place.x - 0.30f;
  for (std::uint32_t board = 0; board < 4; ++board) {
    const float up = 0.24f + 0.27f * static_cast<float>(board) - place.y;
    if (from_shelf < 0 || up > 0.27f || up < -0.022f) continue;
    c = glm::vec3(0.10f, 0.065f, 0.04f) * (0.75f + 0.25f * std::clamp(1.0f - up * 4, 0.0f, 1.0f));
    if (up < 0)
      c = glm::vec3(0.24f, 0.15f, 0.085f) * (1.0f + 0.12f * value_noise({place.x * 9, place.y * 90, 2}, 73));
    if (const auto book = books({from_shelf, up}, look.seed * 31 + board)) c = *book;
  }
  if (std::abs(place.x + 0.44f) < 0.105f && std::abs(place.y - 0.22f) < 0.135f) {  // a picture on the wall
    const glm::vec2 d{std::abs(place.x + 0.44f), std::abs(place.y - 0.22f)};
    const bool frame = d.x > 0.09f || d.y > 0.12f;
    const float hills = place.y - 0.25f - 0.025f * std::sin(place.x * 40.0f);
    c = frame       ? glm::vec3(0.06f, 0.04f, 0.03f)
        : hills > 0 ? glm::vec3(0.10f, 0.16f, 0.07f)
                    : glm::vec3(0.36f, 0.46f, 0.55f) * (0.7f + place.y);
  }
  if (const auto leaf = plant({place.x + 0.50f, 0.86f - place.y}, look.seed * 17)) c = *leaf;
  return c;
}

std::optional<Material> body(glm::vec2 place, const BodyState& state, const Look& look) {
  const float x = std::abs(place.x);
  const float top = jacket_top(x);
  const float lapel = 0.62f - 0.30f * (place.y - kShoulderTop);
  if (place.y > top && x > lapel) return jacket(place, top, lapel, state, look);

  const float collar = 2.20f + 0.38f * (0.6f - x) / 0.6f - 0.06f;
  if (place.y > collar && x < 0.62f) return shirt(place, collar, state, look);

  const float down = smooth_step(state.neck_top.y, 2.3f, place.y);
  const float centre = state.neck_top.x * (1.0f - down);
  const float half = 0.56f + 0.30f * square(square(std::max(0.0f, down)));
  if (place.y > state.neck_top.y - 0.3f && std::abs(place.x - centre) < half && place.y < 2.7f) {
    return neck_skin(place, centre, half, state, look);
  }
  return std::nullopt;
}

}  // namespace fbs::talker
