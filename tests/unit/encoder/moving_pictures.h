// Pictures without a face that move in known ways.
#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>

#include "tests/unit/encoder/patterns/scenery.h"

namespace fbs {

/// Value noise, -1..1: random at whole positions, smooth between.
inline double smooth_noise(double x, double y) {
  const auto value = [](double column, double row) {
    auto h = static_cast<std::uint32_t>(static_cast<std::int32_t>(column)) * 0x9E3779B1U ^
             static_cast<std::uint32_t>(static_cast<std::int32_t>(row)) * 0x85EBCA77U;
    h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    return static_cast<double>((h ^ (h >> 13)) & 0xFFFF) / 32768 - 1;
  };
  const double c = std::floor(x), r = std::floor(y);
  const auto ease = [](double t) { return t * t * (3 - 2 * t); };
  const double u = ease(x - c), v = ease(y - r);
  return (1 - v) * ((1 - u) * value(c, r) + u * value(c + 1, r)) +
         v * ((1 - u) * value(c, r + 1) + u * value(c + 1, r + 1));
}

/// A wall that goes on for ever and is different everywhere.
inline double wall(double x, double y) {
  return 128 + 70 * smooth_noise(x / 19, y / 19) + 40 * smooth_noise(x / 7, y / 7);
}

/// What a camera sees of the wall.
/// @param turn, shift  of the wall's content about the middle of the picture, pixels
inline Picture seen_wall(int width, int height, std::complex<double> turn, std::complex<double> shift) {
  Picture p(width, height);
  const std::complex<double> middle(width / 2.0, height / 2.0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto at = (std::complex(x + 0.5, y + 0.5) - middle - shift) / turn;
      p.y.row(y)[x] = static_cast<std::uint8_t>(wall(at.real(), at.imag()));
    }
  for (auto& s : p.u.samples) s = 120;
  for (auto& s : p.v.samples) s = 135;
  return p;
}

/// Bright squares that go in circles over a still ground.
inline Picture circling_squares(int width, int height, int time) {
  Picture p = scenery(width, height);
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * (i / 3.0 + time / 50.0);
    const int left = static_cast<int>(width / 2.0 + 0.3 * width * std::cos(angle)) - 6;
    const int top = static_cast<int>(height / 2.0 + 0.3 * height * std::sin(angle)) - 6;
    for (int y = top; y < top + 12; ++y)
      for (int x = left; x < left + 12; ++x) p.y.row(y)[x] = 235;
  }
  return p;
}

}  // namespace fbs
