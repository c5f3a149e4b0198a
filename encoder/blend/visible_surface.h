// The scene's triangle that is visible at each sample of a picture, at a reduced size.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "decoder/animate/scene_geometry.h"

namespace fbs {

/// A triangle of surround or head.
struct SurfaceTriangle {
  std::array<std::uint16_t, 3> corners;  ///< points of the surround's grid, or vertices of head_mesh()
  bool head;
};

/// Consecutive samples of a row that show the same triangle.
struct SurfaceRun {
  std::int32_t row, first, count;
  std::uint32_t triangle;
};

/// Position of a sample inside its triangle, linear over the triangle: the weights of corners 1 and 2.
struct Barycentric {
  glm::vec2 origin, per_column, per_row;  ///< at sample (0, 0), and increments per sample
};

/// The reduction is by a power of two; sample (c, r) covers that many pixels each way.
class VisibleSurface {
 public:
  /// @param reduction  log2; 0: the size of the picture
  VisibleSurface(const SceneGeometry& geometry, const ScreenMesh& mesh, int width, int height, int reduction);

  /// Triangle by triangle, and by row in each.
  [[nodiscard]] const std::vector<SurfaceRun>& runs() const { return runs_; }
  [[nodiscard]] std::span<const SurfaceRun> runs_of(std::uint32_t triangle) const {
    return std::span(runs_).subspan(first_run_[triangle], first_run_[triangle + 1] - first_run_[triangle]);
  }
  [[nodiscard]] const std::vector<SurfaceTriangle>& triangles() const { return *triangles_; }
  [[nodiscard]] const Barycentric& barycentric(std::uint32_t triangle) const {
    return barycentric_[triangle];
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  std::shared_ptr<const std::vector<SurfaceTriangle>> triangles_;
  std::vector<Barycentric> barycentric_;
  std::vector<SurfaceRun> runs_;
  std::vector<std::uint32_t> first_run_;  ///< of each triangle; at last, their number
  int width_, height_;
};

}  // namespace fbs
