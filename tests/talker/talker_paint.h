// The paint of the talker's head: skin, brows, eyes, lips, teeth, hair. Colours are linear RGB, 0..1.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "tests/talker/talker_head.h"

namespace fbs::talker {

/// The colours of one person and their clothes, linear RGB, and the seed of their texture.
struct Look {
  glm::vec3 skin, blush, lips, hair, brow, iris, jacket, shirt, wall;
  std::uint32_t seed = 1;
};

/// One of a few appearances; the same seed always gives the same person.
[[nodiscard]] Look look_of(std::uint32_t seed);

/// Material at a point of the surface.
struct Material {
  glm::vec3 albedo{0.5f};
  float occlusion = 1;   ///< factor on all light
  float gloss = 0;       ///< strength of the highlight
  float shininess = 20;  ///< exponent of the highlight
  glm::vec3 normal{0};   ///< head frame; the surface's own when zero
};

/// A ray arriving at the surface.
struct Arrival {
  glm::vec3 direction;    ///< of the ray, head frame, length 1
  glm::vec3 highlight;    ///< direction halfway between the key light and the viewer, head frame, length 1
  float pixels_per_unit;  ///< pixels per eye distance: limits the detail
};

[[nodiscard]] Material paint(const SurfacePoint& point, const Expression& e, const Look& look,
                             const Arrival& arrival);

/// Noise of `octaves` frequencies, starting at `frequency` lumps per unit; detail finer than a pixel is left
/// out.
[[nodiscard]] float texture_noise(glm::vec3 p, float frequency, int octaves, float pixels_per_unit,
                                  std::uint32_t seed);

}  // namespace fbs::talker
