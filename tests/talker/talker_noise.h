// Integer-hash noise and the soft shapes that the talker is made of. No state: same input, same number.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace fbs::talker {

/// A well mixed 32-bit hash (the finaliser of MurmurHash3 over a sum of products).
[[nodiscard]] inline std::uint32_t hash(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0,
                                        std::uint32_t d = 0) {
  std::uint32_t h = a * 0x9E3779B1u + b * 0x85EBCA77u + c * 0xC2B2AE3Du + d * 0x27D4EB2Fu + 0x165667B1u;
  h ^= h >> 16;
  h *= 0x85EBCA6Bu;
  h ^= h >> 13;
  h *= 0xC2B2AE35u;
  return h ^ (h >> 16);
}

/// Uniform in [0, 1).
[[nodiscard]] inline float hash01(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0,
                                  std::uint32_t d = 0) {
  return static_cast<float>(hash(a, b, c, d) >> 8) * (1.0f / 16777216.0f);
}

/// Smooth value noise in -1..1, one lump per unit of p; repeats every 32 units.
[[nodiscard]] float value_noise(glm::vec3 p, std::uint32_t seed);

/// Approximately normal, variance 1, within -3.5..3.5 (sum of the bytes of one hash).
[[nodiscard]] float normal_noise(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

/// 0 below a, 1 above b, a cubic between; a < b.
[[nodiscard]] inline float smooth_step(float a, float b, float x) {
  const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// A bell with bounded support, close to exp(-r2): 1 at 0, 0 from r2 = 3 on, twice differentiable.
[[nodiscard]] inline float bell(float r2) {
  const float k = std::max(0.0f, 1.0f - r2 * (1.0f / 3.0f));
  return k * k * k;
}

[[nodiscard]] inline float square(float x) {
  return x * x;
}

/// The bell around (cx, cy) with radii (sx, sy).
[[nodiscard]] inline float bell(float x, float y, float cx, float cy, float sx, float sy) {
  return bell(square((x - cx) / sx) + square((y - cy) / sy));
}

}  // namespace fbs::talker
