// A scene with a face made of the generic head and random paint, for tests of the decoder without an encoder.
#pragma once

#include <algorithm>
#include <random>
#include <stdexcept>

#include "decoder/draw/renderer.h"

namespace fbs {

inline Plane noise_plane(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Plane plane(width, height);
  for (auto& s : plane.samples) s = static_cast<std::uint8_t>(random());
  return plane;
}

/// A picture of such planes.
inline Picture picture_of(Plane (*plane)(int, int, unsigned), int width, int height, unsigned seed) {
  Picture picture(width, height);
  picture.y = plane(width, height, seed);
  picture.u = plane(picture.u.width, picture.u.height, seed + 1);
  picture.v = plane(picture.v.width, picture.v.height, seed + 2);
  return picture;
}

inline Picture noise_picture(int width, int height, unsigned seed) {
  return picture_of(noise_plane, width, height, seed);
}

/// Noise that changes over six samples: places differ, and a shift by a pixel does not destroy
/// them.
inline Plane smooth_plane(int width, int height, unsigned seed) {
  constexpr int kGrid = 6;
  const Plane coarse = noise_plane(width / kGrid + 2, height / kGrid + 2, seed);
  Plane out(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double fx = x % kGrid / (1.0 * kGrid), fy = y % kGrid / (1.0 * kGrid);
      const auto at = [&](int i, int j) {
        return static_cast<double>(coarse.row(y / kGrid + j)[x / kGrid + i]);
      };
      out.row(y)[x] = static_cast<std::uint8_t>((at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) +
                                                (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy);
    }
  }
  return out;
}

/// Finest steps, so that tests can write angles, pixels and head units.
inline Setup toy_setup(int width = 160, int height = 128) {
  Setup setup;
  setup.format.width = width;
  setup.format.height = height;
  setup.steps = {1, 1, 1, 1, 1};
  return setup;
}

inline Geometry toy_geometry() {
  Geometry geometry;
  for (std::size_t v = 0; v < kVertexCount; ++v) geometry.positions[v] = generic_head().vertices[v].position;
  return geometry;
}

/// Frontal, the eyes 32 pixels apart, at (x, y) pixels.
inline State toy_state(int x = 80, int y = 50) {
  State state;
  state.pose[kShiftX] = x * 64;
  state.pose[kShiftY] = y * 64;
  state.pose[kLogScale] = 5 * 4096;
  return state;
}

/// A state at rest but for its pose, in steps of one.
inline CodedState coded_pose(const State& state) {
  CodedState coded{};
  std::copy(state.pose.begin(), state.pose.end(), coded.begin());
  return coded;
}

/// The same shares everywhere inside; the border moves with the ground.
inline SurroundMap even_surround(int columns, int rows, int head, int body = 0) {
  SurroundMap map{columns, rows, {}, {}};
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) {
      const bool border = r == 0 || c == 0 || r == rows || c == columns;
      map.head.push_back(static_cast<std::uint8_t>(border ? 0 : head));
      map.body.push_back(static_cast<std::uint8_t>(border ? 0 : body));
    }
  }
  return map;
}

/// A scene whose pattern is `picture`, seen in toy_state().
inline Scene toy_scene(Picture picture, SurroundMap surround = even_surround(10, 8, 0)) {
  Scene scene;
  scene.setup = toy_setup(picture.width(), picture.height());
  scene.geometry.emplace(scene.setup, toy_geometry(), std::move(surround), toy_state());
  scene.patterns.push_back(make_pattern(std::move(picture), toy_state(), scene.geometry));
  return scene;
}

/// Any numbers that a stream may hold, often at a limit.
inline CodedState random_coded(std::mt19937& random, const CodedLimits& limits) {
  CodedState coded;
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const auto range = static_cast<unsigned>(limits.max[i] - limits.min[i] + 1);
    switch (random() % 5) {
      case 0:
        coded[i] = limits.max[i];
        break;
      case 1:
        coded[i] = limits.min[i];
        break;
      case 2:
        coded[i] = 0;
        break;
      default:
        coded[i] = limits.min[i] + static_cast<std::int32_t>(random() % range);
    }
  }
  return coded;
}

/// Any state that a stream may hold.
inline State random_state(std::mt19937& random) {
  const QuantiserSteps finest{1, 1, 1, 1, 1};
  return state_of(random_coded(random, {finest, kAllParts}), finest);
}

inline Picture rendered(const Scene& scene, const State& state) {
  Renderer renderer;
  Picture out;
  if (const auto drawn = renderer.render(scene, state, out); !drawn)
    throw std::logic_error(drawn.error().text);
  return out;
}

/// Squared luma difference between two pictures.
inline double squares(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.y.samples.size(); ++i) {
    const double d = a.y.samples[i] - b.y.samples[i];
    sum += d * d;
  }
  return sum;
}

}  // namespace fbs
