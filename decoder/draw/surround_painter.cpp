#include "decoder/draw/surround_painter.h"

#include <algorithm>

namespace fbs {

void SurroundPainter::draw(const Surround::Cell& cell) {
  if (is_ground_at_rest(cell)) return;
  draw_half({cell[0], cell[1], cell[2]});
  draw_half({cell[0], cell[2], cell[3]});
}

bool SurroundPainter::is_ground_at_rest(const Surround::Cell& cell) const {
  return std::all_of(cell.begin(), cell.end(), [&](int point) {
    const auto weights = d_.blend.surround.at(point);
    if (!std::equal(weights.begin(), weights.end(), d_.blend.ground.begin())) return false;
    for (std::size_t s = 0; s < weights.size(); ++s) {
      const TextureMesh* texture = d_.sources[s].texture;
      if (weights[s] != 0 && texture != nullptr && d_.mesh.surround[point] != texture->seen_surround[point])
        return false;
    }
    return true;
  });
}

void SurroundPainter::draw_half(const std::array<int, 3>& points) {
  const auto corners = [&](const std::vector<glm::ivec2>& at) {
    return std::array{at[points[0]], at[points[1]], at[points[2]]};
  };
  sources_.collect(d_, d_.blend.surround, points, [&](const DrawnSource& source) {
    return corners(source.texture == nullptr ? d_.mesh.surround : source.texture->surround);
  });
  const auto at = corners(d_.mesh.surround);
  const ScreenTriangle triangle = {{{at[0]}, {at[1]}, {at[2]}}};
  for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
    if (d_.area(scale).empty()) continue;
    sources_.set_scale(scale);
    draw_triangle(triangle, sources_.all(), {scale, planes_of_scale(d_.target, scale), d_.area(scale)});
  }
}

}  // namespace fbs
