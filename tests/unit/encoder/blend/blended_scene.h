// A scene with several patterns, each seen in its own state: paint that all share and, for a third, their
// own.
#pragma once

#include <array>

#include "encoder/blend/source_samples.h"
#include "tests/unit/encoder/fit/seen_scene.h"

namespace fbs {

struct BlendedScene {
  static constexpr int kWidth = SeenScene::kWidth, kHeight = SeenScene::kHeight;
  static constexpr int kSpacing = 10;  ///< pictures from one pattern to the next

  Scene scene;

  explicit BlendedScene(std::size_t patterns, unsigned seed = 1, int width = kWidth, int height = kHeight) {
    scene.setup = toy_setup(width, height);
    scene.setup.mouth.upper = scene.setup.mouth.lower = {60, 100, 150};
    scene.geometry.emplace(scene.setup, toy_geometry(), even_surround(10, 8, 4, 5), SeenScene::rest());
    StateMaker maker(seed);
    for (std::size_t k = 0; k < patterns; ++k) {
      State seen = SeenScene::rest();
      if (k > 0) maker.pose(seen), maker.expression(seen);
      seen.picture = static_cast<std::int32_t>(k) * kSpacing;
      add_pattern(seen, seed + 10 * static_cast<unsigned>(k));
    }
  }

  void add_pattern(const State& seen, unsigned paint) {
    const VideoFormat& format = scene.setup.format;
    Picture picture(format.width, format.height);
    const auto paint_plane = [&](Plane& plane, unsigned component) {
      plane = wave_plane(plane.width, plane.height, component);
      const Plane own = wave_plane(plane.width, plane.height, 3 * paint + component);
      for (std::size_t i = 0; i < own.samples.size(); ++i)
        plane.samples[i] = static_cast<std::uint8_t>((2 * plane.samples[i] + own.samples[i]) / 3);
    };
    paint_plane(picture.y, 1000), paint_plane(picture.u, 1001), paint_plane(picture.v, 1002);
    scene.patterns.push_back(make_pattern(std::move(picture), seen, scene.geometry));
  }

  [[nodiscard]] BlendScene blend() const { return {*scene.geometry, scene.setup.mouth, scene.patterns}; }

  [[nodiscard]] std::vector<std::size_t> all() const {
    std::vector<std::size_t> out(scene.patterns.size());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = k;
    return out;
  }
};

inline State with_mode(State state, BlendMode mode) {
  state.blend.fill(mode);
  return state;
}

inline BlendMode nearest(int rank) {
  return static_cast<BlendMode>(static_cast<int>(BlendMode::kNearest) + rank);
}

}  // namespace fbs
