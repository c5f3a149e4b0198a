#include "encoder/blend/visible_surface.h"

#include <algorithm>
#include <numeric>

#include "decoder/head/head_mesh.h"
#include "decoder/head/head_projection.h"
#include "decoder/raster/row_runs.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {
namespace {

constexpr std::uint32_t kNothing = ~std::uint32_t{0};

std::vector<SurfaceTriangle> all_triangles(const SceneGeometry& geometry) {
  std::vector<SurfaceTriangle> out;
  const auto point = [](std::int32_t k) { return static_cast<std::uint16_t>(k); };
  for (const MeshTriangle& t : geometry.surround().triangles())
    out.push_back({{point(t[0]), point(t[1]), point(t[2])}, false});
  for (const HeadTriangle& t : generic_head_mesh().triangles) out.push_back({t, true});
  return out;
}

ScreenTriangle on_screen(const SurfaceTriangle& triangle, const ScreenMesh& mesh) {
  ScreenTriangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint16_t k = triangle.corners[i];
    if (triangle.head)
      t[i] = {{mesh.head[k].x, mesh.head[k].y}, mesh.head[k].z};
    else
      t[i] = {mesh.surround[k], 0};
  }
  return t;
}

Barycentric barycentric_of(const ScreenTriangle& t, int position_bits) {
  const float one = static_cast<float>(1 << position_bits);
  const auto at = [&](std::size_t i) { return glm::vec2(t[i].at) / one; };
  const glm::vec2 a = at(1) - at(0), b = at(2) - at(0);
  const float area = a.x * b.y - a.y * b.x;
  const glm::vec2 per_column = glm::vec2(b.y, -a.y) / area, per_row = glm::vec2(-b.x, a.x) / area;
  const glm::vec2 from = glm::vec2(0.5F) - at(0);  // the centre of sample (0, 0)
  return {from.x * per_column + from.y * per_row, per_column, per_row};
}

}  // namespace

VisibleSurface::VisibleSurface(const SceneGeometry& geometry, const ScreenMesh& mesh, int width, int height,
                               int reduction)
    : triangles_(std::make_shared<std::vector<SurfaceTriangle>>(all_triangles(geometry))),
      barycentric_(triangles_->size()),
      width_(width >> reduction),
      height_(height >> reduction) {
  const auto scale = static_cast<PlaneScale>(kScreenOneLog2 + reduction);
  const SampleArea area{0, 0, width_, height_};
  std::vector<std::uint32_t> shown(static_cast<std::size_t>(width_) * height_, kNothing);
  DepthPlane depth;
  depth.reset(width_, height_, area);
  for (std::uint32_t k = 0; k < triangles_->size(); ++k) {
    const SurfaceTriangle& triangle = (*triangles_)[k];
    const ScreenTriangle t = on_screen(triangle, mesh);
    const TriangleSetup setup(t, scale);
    if (!setup.faces_viewer()) continue;
    barycentric_[k] = barycentric_of(t, static_cast<int>(scale));
    const Gradient z = setup.gradient({t[0].depth, t[1].depth, t[2].depth}, kGradientOneLog2);
    for (int row = std::max(0, setup.first_row()); row <= std::min(height_ - 1, setup.last_row()); ++row) {
      const RowRun run = covered_run(setup.edges(), row, area);
      if (run.empty()) continue;
      std::uint32_t* out = shown.data() + static_cast<std::ptrdiff_t>(row) * width_;
      const auto show = [&](RowRun r) { std::fill(out + r.first, out + r.last + 1, k); };
      if (triangle.head)
        for_each_nearer(depth.row(row), run,
                        {z.at(setup.from_corner(run.first, row), setup.position_bits()), z.dx}, show);
      else
        show(run);
    }
  }
  std::vector<SurfaceRun> by_row;
  first_run_.resize(triangles_->size() + 1);
  for (int row = 0; row < height_; ++row) {
    const std::uint32_t* r = shown.data() + static_cast<std::ptrdiff_t>(row) * width_;
    for (int x = 0; x < width_;) {
      int end = x + 1;
      while (end < width_ && r[end] == r[x]) ++end;
      if (r[x] != kNothing) {
        by_row.push_back({row, x, end - x, r[x]});
        ++first_run_[r[x] + 1];
      }
      x = end;
    }
  }
  std::partial_sum(first_run_.begin(), first_run_.end(), first_run_.begin());
  runs_.resize(by_row.size());
  std::vector<std::uint32_t> next = first_run_;
  for (const SurfaceRun& run : by_row) runs_[next[run.triangle]++] = run;
}

}  // namespace fbs
