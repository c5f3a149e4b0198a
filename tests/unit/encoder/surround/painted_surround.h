// A painted head before painted shoulders before painted ground, each moved independently.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "encoder/model/pose.h"
#include "encoder/surround/similarity.h"
#include "tests/unit/toy_scene.h"

namespace fbs {

inline constexpr int kWidth = 320, kHeight = 240;
inline constexpr double kEyePx = 30;
inline constexpr glm::dvec2 kHeadAt(160, 100);

/// Waves in all directions: known between the pixels, too.
class Paint {
 public:
  explicit Paint(unsigned seed) {
    std::mt19937 random(seed);
    const auto share = [&] { return random() % 1000 / 1000.0; };
    for (Wave& w : waves_) {
      const double length = 14 + 30 * share(), towards = 6.2832 * share();
      w = {6.2832 / length * glm::dvec2(std::cos(towards), std::sin(towards)), 6.2832 * share()};
    }
  }
  [[nodiscard]] double at(glm::dvec2 p) const {
    double sum = 128;
    for (const Wave& w : waves_) sum += 17 * std::sin(w.number.x * p.x + w.number.y * p.y + w.phase);
    return sum;
  }

 private:
  struct Wave {
    glm::dvec2 number;
    double phase;
  };
  std::array<Wave, 6> waves_;
};

/// The position in the first picture of what is now at `p`.
inline glm::dvec2 before(glm::dvec2 p, const Similarity& by) {
  const glm::dvec2 moved(by[kDisplacementX], by[kDisplacementY]);
  const glm::dvec2 d = p - kHeadAt - moved;
  const auto q =
      std::complex(d.x, d.y) / (1.0 + std::complex(by[kSimilarityScale], by[kSimilarityRotation]) / kEyePx);
  return kHeadAt + glm::dvec2(q.real(), q.imag());
}

/// Positions of everything in a picture.
struct Shown {
  glm::dvec2 head{};  ///< pixels from kHeadAt
  Similarity body{}, ground{};
};

inline State seen_state() {
  State state = toy_state(160, 100);
  state.pose[kLogScale] = static_cast<std::int32_t>(std::lround(4096 * std::log2(kEyePx)));
  return state;
}

inline Pose head_of(const Shown& shown) {
  Pose pose = pose_of(seen_state());
  pose.shift += shown.head;
  return pose;
}

/// A head, an ellipse of its own paint, before shoulders before the ground.
/// @param noise  grey levels either way
inline Picture picture_of(const Shown& shown, int noise = 0, bool with_body = true) {
  static const Paint head(1), body(2), ground(3);
  std::mt19937 random(7);
  Picture out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      const glm::dvec2 h = (p - shown.head - kHeadAt) / kEyePx;
      const glm::dvec2 b = before(p, shown.body), own = (b - kHeadAt) / kEyePx;
      double value = 0;
      if (std::hypot(h.x / 1.4, (h.y - 0.3) / 1.9) < 1)
        value = head.at(p - shown.head);
      else if (with_body && own.y > 1.8 + 0.4 * std::abs(own.x))
        value = body.at(b);
      else
        value = ground.at(before(p, shown.ground));
      if (noise > 0) value += static_cast<double>(random() % static_cast<unsigned>(2 * noise + 1)) - noise;
      out.y.row(y)[x] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
  }
  return out;
}

}  // namespace fbs
