#include "decoder/atlas/atlas_layout.h"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <utility>

#include "common/generic_head.h"
#include "decoder/head/fixed_math.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

/// Room for the skirt to the right of the vertices and the ring and below them, 1/4096 eye distance.
constexpr std::int32_t kMargin = 573;
constexpr int kTableToScreenLog2 = kHeadOneLog2 - kScreenOneLog2;

/// Eye distances of atlases: multiples of this.
constexpr int kSizeStep = 16, kMinSteps = 4, kMaxSteps = 10;

glm::ivec2 scaled(glm::ivec2 table, int eye_distance) {
  constexpr int kHalf = 1 << (kTableToScreenLog2 - 1);
  return {(table.x * eye_distance + kHalf) >> kTableToScreenLog2,
          (table.y * eye_distance + kHalf) >> kTableToScreenLog2};
}

std::vector<MeshTriangle> all_triangles(const HeadMesh& mesh) {
  std::vector<MeshTriangle> out;
  for (const HeadTriangle& t : mesh.triangles) out.push_back({t[0], t[1], t[2]});
  const auto ring = static_cast<std::int32_t>(mesh.head_count),
             skirt = static_cast<std::int32_t>(mesh.vertex_count), n = skirt - ring;
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t j = (i + 1) % n;
    out.push_back({ring + i, skirt + i, skirt + j});
    out.push_back({ring + i, skirt + j, ring + j});
  }
  return out;
}

std::int64_t cross(glm::ivec2 a, glm::ivec2 b) {
  return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
}

/// Whether drawing the head may read any sample of a block: whether the block lies in one of the head's
/// triangles or a little beside it.
/// @param triangles  of the HeadMesh
bool is_read(glm::ivec2 block, const AtlasLayout& layout, std::span<const MeshTriangle> triangles) {
  constexpr int kBeside = 3 << kScreenOneLog2;  // bilinear and chroma samples, and rounding of gradients
  constexpr int kSize = kBlockSize << kScreenOneLog2;
  const glm::ivec2 first = block * kSize - kBeside, last = (block + 1) * kSize + kBeside;
  return std::any_of(triangles.begin(), triangles.end(), [&](const MeshTriangle& t) {
    std::array<glm::ivec2, 3> p{layout.points[t[0]], layout.points[t[1]], layout.points[t[2]]};
    // Triangles that are turned over in the atlas are read like any other.
    if (cross(p[1] - p[0], p[2] - p[0]) < 0) std::swap(p[1], p[2]);
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    if (left > last.x || right < first.x || top > last.y || bottom < first.y) return false;
    for (std::size_t k = 0; k < p.size(); ++k) {  // the whole block on the outer side of an edge?
      const glm::ivec2 along = p[(k + 1) % p.size()] - p[k];
      const glm::ivec2 corner(along.y < 0 ? last.x : first.x, along.x > 0 ? last.y : first.y);
      const glm::ivec2 to = corner - p[k];
      if (cross(along, to) < 0) return false;
    }
    return true;
  });
}

}  // namespace

glm::ivec2 skirt_point(glm::ivec2 outline, glm::ivec2 ring) {
  const glm::ivec2 by = ring - outline;
  return {clamp_screen(ring.x + by.x / 2), clamp_screen(ring.y + by.y / 2)};
}

AtlasLayout::AtlasLayout(const WireFrame& head, int eye_distance)
    : head_count(head.vertices.size()), outline(head.outline.begin(), head.outline.end()) {
  const HeadMesh mesh(head);
  triangles = all_triangles(mesh);
  glm::ivec2 size(0);
  for (const glm::ivec2 p : head.atlas) {
    size = {std::max(size.x, p.x), std::max(size.y, p.y)};
    points.push_back(scaled(p, eye_distance));
  }
  size = scaled(size + kMargin, eye_distance);
  const NodeGrid grid((size.x >> kScreenOneLog2) + 1, (size.y >> kScreenOneLog2) + 1);
  width = grid.block_columns * kBlockSize;
  height = grid.block_rows * kBlockSize;
  add_skirt(points);

  cover.find(grid, triangles, points);
  cover.take_nearest(points);
  const auto of_head = std::span(triangles).first(mesh.triangles.size());
  for (int row = 0; row < grid.block_rows; ++row)
    for (int column = 0; column < grid.block_columns; ++column)
      if (is_read({column, row}, *this, of_head)) blocks.emplace_back(column, row);
}

void AtlasLayout::add_skirt(std::vector<glm::ivec2>& at) const {
  for (std::size_t i = 0; i < outline.size(); ++i)
    at.push_back(skirt_point(at[outline[i]], at[head_count + i]));
}

int atlas_eye_distance(std::int64_t scale) {
  const std::int64_t enlarged = (scale * 5) >> (kScaleOneLog2 + 2);
  return static_cast<int>(
      kSizeStep * std::clamp<std::int64_t>((enlarged + kSizeStep - 1) / kSizeStep, kMinSteps, kMaxSteps));
}

const AtlasLayout& generic_atlas_layout(std::int64_t scale) {
  static std::array<std::once_flag, kMaxSteps + 1> once;
  static std::array<std::unique_ptr<const AtlasLayout>, kMaxSteps + 1> layouts;
  const int eye_distance = atlas_eye_distance(scale);
  const std::size_t steps = eye_distance / kSizeStep;
  std::call_once(once[steps],
                 [&] { layouts[steps] = std::make_unique<const AtlasLayout>(generic_head(), eye_distance); });
  return *layouts[steps];
}

}  // namespace fbs
