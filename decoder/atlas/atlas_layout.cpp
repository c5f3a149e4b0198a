#include "decoder/atlas/atlas_layout.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>

#include "decoder/head/fixed_math.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

/// The atlas of the table, 1/4096 eye distance.
constexpr glm::ivec2 kTableSize(15365, 17039);
constexpr int kTableToScreenLog2 = kHeadOneLog2 - kScreenOneLog2;

/// Eye distances of atlases: multiples of this.
constexpr int kSizeStep = 16, kMinSteps = 4, kMaxSteps = 10;

glm::ivec2 scaled(glm::ivec2 table, int eye_distance) {
  constexpr int kHalf = 1 << (kTableToScreenLog2 - 1);
  return {(table.x * eye_distance + kHalf) >> kTableToScreenLog2,
          (table.y * eye_distance + kHalf) >> kTableToScreenLog2};
}

std::vector<MeshTriangle> all_triangles() {
  std::vector<MeshTriangle> out;
  for (const HeadTriangle& t : head_mesh().triangles) out.push_back({t[0], t[1], t[2]});
  const auto ring = static_cast<std::int32_t>(generic_head().outline.size());
  constexpr std::int32_t kRing = kVertexCount;
  for (std::int32_t i = 0; i < ring; ++i) {
    const std::int32_t j = (i + 1) % ring, skirt = kRing + ring;
    out.push_back({kRing + i, skirt + i, skirt + j});
    out.push_back({kRing + i, skirt + j, kRing + j});
  }
  return out;
}

/// Whether the bounding box of some triangle and the block have samples in common.
bool may_reach(glm::ivec2 block, const AtlasLayout& layout) {
  constexpr int kSize = kBlockSize << kScreenOneLog2;
  const glm::ivec2 first = block * kSize, last = first + kSize;
  return std::any_of(layout.triangles.begin(), layout.triangles.end(), [&](const MeshTriangle& t) {
    const glm::ivec2 a = layout.points[t[0]], b = layout.points[t[1]], c = layout.points[t[2]];
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    return left <= last.x && right >= first.x && top <= last.y && bottom >= first.y;
  });
}

}  // namespace

glm::ivec2 skirt_point(glm::ivec2 outline, glm::ivec2 ring) {
  const glm::ivec2 by = ring - outline;
  return {clamp_screen(ring.x + by.x / 2), clamp_screen(ring.y + by.y / 2)};
}

void add_skirt(std::vector<glm::ivec2>& points) {
  for (std::size_t i = 0; i < generic_head().outline.size(); ++i)
    points.push_back(skirt_point(points[generic_head().outline[i]], points[kVertexCount + i]));
}

AtlasLayout::AtlasLayout(int eye_distance) : triangles(all_triangles()) {
  const glm::ivec2 size = scaled(kTableSize, eye_distance);
  const NodeGrid grid((size.x >> kScreenOneLog2) + 1, (size.y >> kScreenOneLog2) + 1);
  width = grid.block_columns * kBlockSize;
  height = grid.block_rows * kBlockSize;
  for (const glm::ivec2 p : kAtlasTable) points.push_back(scaled(p, eye_distance));
  add_skirt(points);

  cover.find(grid, triangles, points);
  cover.take_nearest(points);
  for (int row = 0; row < grid.block_rows; ++row)
    for (int column = 0; column < grid.block_columns; ++column)
      if (may_reach({column, row}, *this)) blocks.emplace_back(column, row);
}

const AtlasLayout& atlas_layout(std::int64_t scale) {
  static std::array<std::once_flag, kMaxSteps + 1> once;
  static std::array<std::unique_ptr<const AtlasLayout>, kMaxSteps + 1> layouts;
  const auto steps = static_cast<std::size_t>(std::clamp<std::int64_t>(
      (((scale * 5) >> (kScaleOneLog2 + 2)) + kSizeStep - 1) / kSizeStep, kMinSteps, kMaxSteps));
  std::call_once(once[steps], [&] {
    layouts[steps] = std::make_unique<const AtlasLayout>(kSizeStep * static_cast<int>(steps));
  });
  return *layouts[steps];
}

}  // namespace fbs
