#include "decoder/pattern/contrast_map.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "decoder/head/head_deformation.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/head_projection.h"
#include "decoder/raster/row_runs.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {
namespace {

constexpr int kMiddle = 128, kInverseOneLog2 = 16;
constexpr std::uint8_t kFaceShareOne = 255;

/// Luma samples of a cell, each way.
constexpr int kCellLog2 = 2, kCell = 1 << kCellLog2;

constexpr int kBlurPasses = 3, kMaxBlurRadius = 64;

/// What to multiply differences from the middle by, fixed point.
struct Factor {
  std::int32_t by;
  int one_log2;

  /// The sample, farther from the middle or nearer to it.
  [[nodiscard]] std::uint8_t operator()(std::uint8_t sample) const {
    const std::int32_t difference = ((sample - kMiddle) * by + (1 << (one_log2 - 1))) >> one_log2;
    return static_cast<std::uint8_t>(std::clamp(kMiddle + difference, 0, 255));
  }
};

Factor reducing(std::int32_t contrast) {
  return {contrast, kContrastOneLog2};
}

Factor expanding(std::int32_t contrast) {
  return {((kContrastOne << kInverseOneLog2) + contrast / 2) / contrast, kInverseOneLog2};
}

/// Cells that the head covers in the pattern are kFaceShareOne, others 0.
/// @param vertices  of the head in the pattern, 1/64 pixel
Plane draw_cells(int width, int height, const WireFrame& head, const std::vector<glm::ivec3>& vertices) {
  const auto cells = [](int samples) { return (samples + kCell - 1) / kCell; };
  Plane out(cells(width), cells(height));
  for (const HeadTriangle& triangle : head.triangles) {
    ScreenTriangle t;
    for (std::size_t i = 0; i < t.size(); ++i) t[i].at = glm::ivec2(vertices[triangle[i]]) >> kCellLog2;
    const TriangleSetup setup(t, PlaneScale::kLuma);
    if (!setup.faces_viewer()) continue;
    const int end = std::min(setup.last_row() + 1, out.height);
    for (int y = std::max(setup.first_row(), 0); y < end; ++y) {
      const RowRun run = covered_run(setup.edges(), y, {0, 0, out.width, out.height});
      if (!run.empty()) std::fill_n(out.row(y) + run.first, run.count(), kFaceShareOne);
    }
  }
  return out;
}

/// Replaces values by means over 2 * radius + 1 of them; beyond the ends the last is repeated.
/// @param values, step  the first one, and the distance to the next
void blur(std::uint8_t* values, std::ptrdiff_t step, int count, int radius) {
  std::vector<std::int32_t> before(count);
  for (int i = 0; i < count; ++i) before[i] = values[i * step];
  const auto at = [&](int i) { return before[std::clamp(i, 0, count - 1)]; };
  const std::int32_t n = 2 * radius + 1;
  std::int32_t sum = n / 2;
  for (int i = -radius; i <= radius; ++i) sum += at(i);
  for (int i = 0; i < count; ++i) {
    values[i * step] = static_cast<std::uint8_t>(sum / n);
    sum += at(i + radius + 1) - at(i - radius);
  }
}

/// Cells on each side over which shares are blurred, three times: a sixteenth of the head's width.
int blur_radius(const std::vector<glm::ivec3>& vertices) {
  return std::clamp(face_width(vertices) >> (4 + kCellLog2 + kScreenOneLog2), 1, kMaxBlurRadius);
}

/// Changes each sample by the factor of its share of the face.
/// @param factors  by share, 0..255
void change_luma(Plane& plane, const Plane& cells, std::span<const Factor> factors) {
  const auto place = [](int i) { return 4 * i - 6; };  // in 1/16 cell from the centre of the first one
  std::vector<int> columns(static_cast<std::size_t>(cells.width) + 2);  // of cells -1 to the width
  for (int y = 0; y < plane.height; ++y) {
    const int v = place(y), q = v & 15;
    const std::uint8_t* const top = cells.row(std::clamp(v >> 4, 0, cells.height - 1));
    const std::uint8_t* const bottom = cells.row(std::clamp((v >> 4) + 1, 0, cells.height - 1));
    for (int x = 0; x < cells.width; ++x) columns[x + 1] = top[x] * (16 - q) + bottom[x] * q;
    columns.front() = columns[1];
    columns.back() = columns[cells.width];
    std::uint8_t* const row = plane.row(y);
    const auto first_beyond = [&](int cell) {  // the first sample between this column and the next
      return std::min(plane.width, kCell * (cell - 1) + kCell / 2);
    };
    for (int x = 0, cell = 0; x < plane.width;) {
      int even = cell;  // nearly everywhere neighbouring cells are alike
      while (even <= cells.width && columns[even + 1] == columns[cell]) ++even;
      const int end = first_beyond(std::max(even, cell + 1));
      if (even > cell) {
        const Factor factor = factors[(columns[cell] * 16 + 128) >> 8];
        for (; x < end; ++x) row[x] = factor(row[x]);
      } else {
        for (; x < end; ++x) {
          const int p = place(x) & 15;
          row[x] = factors[(columns[cell] * (16 - p) + columns[cell + 1] * p + 128) >> 8](row[x]);
        }
      }
      cell = std::max(even, cell + 1);
    }
  }
}

/// @param factor_at  of a contrast
void change(Picture& picture, const Plane& cells, std::int32_t surround, std::int32_t chroma_contrast,
            Factor (*factor_at)(std::int32_t contrast)) {
  std::array<Factor, kFaceShareOne + 1> luma{};
  for (int share = 0; share <= kFaceShareOne; ++share)
    luma[share] =
        factor_at(surround + ((kContrastOne - surround) * share + kFaceShareOne / 2) / kFaceShareOne);
  change_luma(picture.y, cells, luma);
  const Factor chroma = factor_at(chroma_contrast);
  for (Plane* plane : {&picture.u, &picture.v})
    for (std::uint8_t& sample : plane->samples) sample = chroma(sample);
}

}  // namespace

ContrastMap::ContrastMap(const Setup& setup, const Geometry& head, const State& seen)
    : surround_(setup.contrast), chroma_(setup.chroma_contrast) {
  const std::vector<glm::ivec3> vertices = project_vertices(head, seen);
  cells_ = draw_cells(setup.format.width, setup.format.height, head.wire_frame(), vertices);
  const int radius = blur_radius(vertices);
  for (int pass = 0; pass < kBlurPasses; ++pass) {
    for (int y = 0; y < cells_.height; ++y) blur(cells_.row(y), 1, cells_.width, radius);
    for (int x = 0; x < cells_.width; ++x) blur(cells_.row(0) + x, cells_.width, cells_.height, radius);
  }
}

void ContrastMap::expand(Picture& picture) const {
  change(picture, cells_, surround_, chroma_, expanding);
}

void ContrastMap::reduce(Picture& picture) const {
  change(picture, cells_, surround_, chroma_, reducing);
}

}  // namespace fbs
