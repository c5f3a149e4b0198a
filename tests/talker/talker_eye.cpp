#include "tests/talker/talker_eye.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/talker/talker_noise.h"

namespace fbs::talker {
namespace {

/// Where a point lies around an eye; u as in lid_edges.
struct EyePlace {
  int side;
  float u;
  float open;
};

EyePlace eye_place(glm::vec3 q, const Expression& e) {
  const int side = q.x < 0 ? -1 : 1;
  return {side, (std::abs(q.x) - kEyeX) / kEyeHalfWidth, side < 0 ? e.eye_open_right : e.eye_open_left};
}

/// Colour of the eyeball at unit vector n from its centre; `look_at` is the direction of gaze.
glm::vec3 eyeball_colour(glm::vec3 n, glm::vec3 look_at, const EyePlace& place, const Look& look) {
  const glm::vec3 off = n - look_at;
  const float r = kEyeballRadius * glm::length(off);  // distance from the pupil's centre
  constexpr float kIris = 0.106f, kPupil = 0.040f, kSoft = 0.010f;
  const float corner = square(std::min(1.0f, std::abs(place.u)));
  const glm::vec3 white =
      glm::mix(glm::vec3(0.66f, 0.64f, 0.62f), glm::vec3(0.55f, 0.36f, 0.32f), 0.6f * corner * corner);
  const float angle = std::atan2(off.y, off.x);
  const float fibres = value_noise({angle * 5.0f, r * 12.0f, static_cast<float>(place.side)}, look.seed + 41);
  glm::vec3 iris = look.iris * (0.85f + 0.35f * fibres) *
                   (0.8f + 0.6f * smooth_step(-0.05f, 0.08f, kEyeballRadius * off.y));
  iris *= 1.0f - 0.65f * smooth_step(0.75f * kIris, kIris, r);
  glm::vec3 c = glm::mix(iris, white, smooth_step(kIris - kSoft, kIris + kSoft, r));
  return glm::mix(glm::vec3(0.004f), c, smooth_step(kPupil - kSoft, kPupil + kSoft, r));
}

}  // namespace

std::optional<Material> paint_eyeball(glm::vec3 rest, const Expression& e, const Look& look,
                                      const Arrival& arrival) {
  const EyePlace place = eye_place(rest, e);
  if (std::abs(place.u) >= 1.0f || std::abs(rest.y) > 0.3f) return std::nullopt;
  const LidEdges edges = lid_edges(place.u, place.open);
  if (rest.y <= edges.upper || rest.y >= edges.lower) return std::nullopt;

  const glm::vec3 o = rest - eyeball_centre(place.side);
  const float along = glm::dot(o, arrival.direction);
  const float inside = along * along - glm::dot(o, o) + kEyeballRadius * kEyeballRadius;
  const glm::vec3 at = o + arrival.direction * (-along - std::sqrt(std::max(0.0f, inside)));
  const glm::vec3 n = glm::normalize(at);
  const float gx = e.gaze.x - 0.02f * static_cast<float>(place.side), gy = e.gaze.y;
  const glm::vec3 look_at{std::sin(gx) * std::cos(gy), std::sin(gy), -std::cos(gx) * std::cos(gy)};

  Material m;
  m.albedo = eyeball_colour(n, look_at, place, look);
  m.normal = n;
  m.occlusion = 0.50f + 0.50f * smooth_step(0.0f, 0.085f, rest.y - edges.upper);  // the lid's shadow
  m.occlusion *= 1.0f - 0.25f * square(square(place.u));
  const float spark = glm::length(n - glm::normalize(arrival.highlight + glm::vec3(0, 0.05f, 0)));
  m.albedo = glm::mix(m.albedo, glm::vec3(1.1f), 1.0f - smooth_step(0.07f, 0.13f, spark));
  if (spark < 0.10f) m.occlusion = 1.0f;
  return m;
}

void paint_lids(Material& skin, glm::vec3 rest, const Expression& e, const Look& look) {
  const EyePlace place = eye_place(rest, e);
  if (std::abs(place.u) > 1.45f || std::abs(rest.y) > 0.4f) return;
  const float u = std::clamp(place.u, -1.0f, 1.0f);
  const float beyond = std::max(0.0f, std::abs(place.u) - 1.0f) * kEyeHalfWidth;
  const LidEdges edges = lid_edges(u, place.open);
  const LidEdges wide = lid_edges(u, kEyeOpenNeutral);

  const float over = edges.upper - rest.y;   // above the upper edge: positive
  const float under = rest.y - edges.lower;  // below the lower edge: positive
  const float outer = smooth_step(-1.0f, 0.9f, place.u);
  const float width = 0.014f + 0.020f * outer;
  const float tail = place.u > 0 ? 0.055f : 0.012f;  // lashes reach beyond the outer corner
  const float ends = 1.0f - smooth_step(0.0f, tail, beyond);
  const float lashes =
      over > -0.02f ? ends * (1.0f - smooth_step(0.35f * width, width * 1.5f, std::abs(over + 0.3f * beyond)))
                    : 0.0f;
  const float lower = 0.45f * ends * bell(square(under / 0.013f)) * smooth_step(-1.0f, 0.2f, place.u);

  // The fold lies above the open lid; as the lid comes down it flattens.
  const float shut = std::clamp(1.0f - place.open / kEyeOpenNeutral, 0.0f, 1.0f);
  const float fold_y = wide.upper - 0.055f + 0.02f * shut;
  const float fold = (0.42f - 0.22f * shut) * bell(square((rest.y - fold_y) / 0.02f)) *
                     (1.0f - smooth_step(0.0f, 0.06f, beyond));
  const float lid = over > 0 && rest.y > fold_y ? 1.0f : 0.0f;

  skin.occlusion *= 1.0f - fold;
  skin.albedo = glm::mix(skin.albedo, skin.albedo * glm::vec3(0.90f, 0.80f, 0.78f),
                         lid * (1.0f - smooth_step(0.0f, 0.04f, beyond)));
  skin.albedo = glm::mix(skin.albedo, look.brow * 0.35f, std::max(0.92f * lashes, lower));
  const float corner = bell(square((place.u + 1.02f) / 0.10f) + square((rest.y - edges.lower) / 0.03f));
  skin.albedo = glm::mix(skin.albedo, look.lips, 0.5f * corner);
}

}  // namespace fbs::talker
