#include "tests/talker/talker_noise.h"

#include <array>

namespace fbs::talker {

namespace {

/// Random numbers on a 32 x 32 x 32 lattice that repeats; small enough for the first-level cache.
constexpr std::uint32_t kLatticeBits = 5, kLatticeMask = (1u << kLatticeBits) - 1;

struct Lattice {
  std::array<std::int8_t, 1u << (3 * kLatticeBits)> values;
  Lattice() {
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<std::int8_t>(static_cast<int>(hash(i, 5) >> 24) - 128);
    }
  }
};

const Lattice kLattice;

}  // namespace

float value_noise(glm::vec3 p, std::uint32_t seed) {
  const auto floor_of = [](float x) {  // without a call into the library
    const auto i = static_cast<std::int32_t>(x);
    return i - (static_cast<float>(i) > x ? 1 : 0);
  };
  const std::int32_t kx = floor_of(p.x), ky = floor_of(p.y), kz = floor_of(p.z);
  const auto fx = static_cast<float>(kx), fy = static_cast<float>(ky), fz = static_cast<float>(kz);
  const std::uint32_t shift = hash(seed);  // different seeds use different parts of the lattice
  const std::uint32_t ix = static_cast<std::uint32_t>(kx) + shift;
  const std::uint32_t iy = static_cast<std::uint32_t>(ky) + (shift >> 8);
  const std::uint32_t iz = static_cast<std::uint32_t>(kz) + (shift >> 16);
  const auto fade = [](float t) { return t * t * (3.0f - 2.0f * t); };
  const float u = fade(p.x - fx), v = fade(p.y - fy), w = fade(p.z - fz);
  const auto edge = [&](std::uint32_t y, std::uint32_t z) {
    const std::uint32_t row =
        ((z & kLatticeMask) << (2 * kLatticeBits)) | ((y & kLatticeMask) << kLatticeBits);
    const float a = kLattice.values[row | (ix & kLatticeMask)],
                b = kLattice.values[row | ((ix + 1) & kLatticeMask)];
    return a + (b - a) * u;
  };
  const auto face = [&](std::uint32_t z) {
    const float a = edge(iy, z), b = edge(iy + 1, z);
    return a + (b - a) * v;
  };
  const float a = face(iz), b = face(iz + 1);
  return (a + (b - a) * w) * (1.0f / 128.0f);
}

float normal_noise(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const std::uint32_t h = hash(a, b, c, d);
  const std::uint32_t sum = (h & 255u) + ((h >> 8) & 255u) + ((h >> 16) & 255u) + (h >> 24);
  constexpr float kMean = 510.0f, kDeviation = 147.8f;  // four uniform bytes
  return (static_cast<float>(sum) - kMean) / kDeviation;
}

}  // namespace fbs::talker
