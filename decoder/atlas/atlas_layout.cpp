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

/// Whether some sample of a block can be read when the head is drawn: whether it lies in one of the head's
/// triangles or a little beside it.
bool is_read(glm::ivec2 block, const AtlasLayout& layout) {
  constexpr int kMargin = 3 << kScreenOneLog2;  // bilinear samples, of chroma, and what gradients round
  constexpr int kSize = kBlockSize << kScreenOneLog2;
  const glm::ivec2 first = block * kSize - kMargin, last = (block + 1) * kSize + kMargin;
  const auto triangles = std::span(layout.triangles).first(head_mesh().triangles.size());
  return std::any_of(triangles.begin(), triangles.end(), [&](const MeshTriangle& t) {
    const std::array<glm::ivec2, 3> p{layout.points[t[0]], layout.points[t[1]], layout.points[t[2]]};
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    if (left > last.x || right < first.x || top > last.y || bottom < first.y) return false;
    for (std::size_t k = 0; k < p.size(); ++k) {  // no edge has the whole block on its outer side
      const glm::ivec2 along = p[(k + 1) % p.size()] - p[k];
      const glm::ivec2 corner(along.y < 0 ? last.x : first.x, along.x > 0 ? last.y : first.y);
      const glm::ivec2 to = corner - p[k];
      if (std::int64_t{along.x} * to.y - std::int64_t{along.y} * to.x < 0) return false;
    }
    return true;
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
      if (is_read({column, row}, *this)) blocks.emplace_back(column, row);
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
