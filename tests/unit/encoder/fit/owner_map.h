// Which triangle of the head the decoder draws where: a plain rasteriser, to tell which sample points are
// seen.
#pragma once

#include <algorithm>
#include <vector>

#include "decoder/animate/screen_mesh.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/mouth_interior.h"
#include "tests/unit/encoder/fit/seen_scene.h"

namespace fbs {

class OwnerMap {
 public:
  explicit OwnerMap(const ScreenMesh& mesh) : owner_(kSize, -1), depth_(kSize, 1e30) {
    const auto& triangles = generic_head_mesh().triangles;
    for (std::size_t t = 0; t < triangles.size(); ++t) draw(mesh, triangles[t], static_cast<int>(t));
  }

  /// Whether the four samples round a place show `triangle` or what adjoins it on the same side of the lips,
  /// so that the picture between them is that surface's.
  [[nodiscard]] bool shows(std::size_t triangle, glm::dvec2 at_px) const {
    const int x = static_cast<int>(std::floor(at_px.x - 0.5));
    const int y = static_cast<int>(std::floor(at_px.y - 0.5));
    const int at = y * kWidth + x;
    const std::array<int, 4> around = {at, at + 1, at + kWidth, at + kWidth + 1};
    return std::all_of(around.begin(), around.end(),
                       [&](int k) { return owner_[k] >= 0 && adjoins(triangle, owner_[k]); });
  }

  /// Whether sample `at` of the picture shows the head, the ring round it apart.
  [[nodiscard]] bool on_head(std::size_t at) const {
    return owner_[at] >= 0 && static_cast<std::size_t>(owner_[at]) < generic_head().triangles.size();
  }

 private:
  static constexpr int kWidth = SeenScene::kWidth, kHeight = SeenScene::kHeight, kSize = kWidth * kHeight;

  static bool adjoins(std::size_t a, int owner) {
    const auto b = static_cast<std::size_t>(owner);
    if (b >= generic_head().triangles.size()) return false;  // of the ring
    const HeadTriangle &s = generic_head_mesh().triangles[a], &t = generic_head_mesh().triangles[b];
    const auto inside = [](const HeadTriangle& h) { return is_mouth(generic_head(), h); };
    return inside(s) == inside(t) && std::any_of(s.begin(), s.end(), [&](std::uint16_t v) {
             return std::find(t.begin(), t.end(), v) != t.end();
           });
  }

  void draw(const ScreenMesh& mesh, const HeadTriangle& triangle, int index) {
    const auto corner = [&](std::size_t i) {
      constexpr double kScreenOne = 1 << kScreenOneLog2;
      return glm::dvec3(mesh.head[triangle[i]]) / glm::dvec3(kScreenOne, kScreenOne, 1);
    };
    const glm::dvec3 a = corner(0), e = corner(1) - a, f = corner(2) - a;
    const double area = e.x * f.y - e.y * f.x;
    if (area <= 0) return;
    const auto range = [](double from, double p, double q, int size) {
      const auto [low, high] = std::minmax({0.0, p, q});
      return std::pair(std::clamp(static_cast<int>(from + low), 0, size),
                       std::clamp(static_cast<int>(from + high) + 1, 0, size));
    };
    const auto [left, right] = range(a.x, e.x, f.x, kWidth);
    const auto [top, bottom] = range(a.y, e.y, f.y, kHeight);
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(a);
        const double u = (d.x * f.y - d.y * f.x) / area, v = (e.x * d.y - e.y * d.x) / area;
        const double z = a.z + u * e.z + v * f.z;
        const int at = y * kWidth + x;
        if (u < 0 || v < 0 || u + v > 1 || z >= depth_[at]) continue;
        depth_[at] = z;
        owner_[at] = index;
      }
  }

  std::vector<int> owner_;
  std::vector<double> depth_;
};

}  // namespace fbs
