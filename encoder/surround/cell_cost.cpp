#include "encoder/surround/cell_cost.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "decoder/animate/scene_geometry.h"
#include "encoder/image/bilinear.h"
#include "encoder/surround/similarity.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

namespace {

constexpr int kScreenPerPixel = static_cast<int>(kStateUnitsPerPixel);

/// Corner-based positions, like the grid's; the border is repeated.
inline float value(const cv::Mat& luma, glm::vec2 at) {
  return bilinear<std::uint8_t>(luma, BilinearCell(clamped(luma, at - 0.5F, 1.01F)));
}

/// Position of a sample in a cell, 0..1.
constexpr float share(std::size_t i) {
  return (static_cast<float>(i) + 0.5F) / kSamplesAcrossCell;
}

/// Area of a cell after its motion over its area before; negative when it has folded.
double area_ratio(const std::array<glm::dvec2, 4>& to, glm::dvec2 size) {
  const glm::dvec2 d1 = to[3] - to[0], d2 = to[2] - to[1];
  return 0.5 * (d1.x * d2.y - d1.y * d2.x) / (size.x * size.y);
}

}  // namespace

CellCost::CellCost(const Setup& setup, const Geometry& geometry, const MapGrid& grid,
                   const SurroundObservations& observations)
    : grid_(grid), observations_(observations) {
  const SceneGeometry scene(setup, geometry, uniform_map(grid, {}), observations.first().state);
  points_ = without_margin(scene.texture_mesh(observations.first().state).surround);
  for (const auto& observation : observations.later())
    later_.push_back(later_picture(setup, geometry, observation));
  if (!later_.empty()) first_ = samples_of_first();
}

std::vector<glm::dvec2> CellCost::without_margin(const std::vector<glm::ivec2>& screen) const {
  std::vector<glm::dvec2> out;
  for (int r = 0; r <= grid_.rows; ++r)
    for (int c = 0; c <= grid_.columns; ++c)
      out.push_back(glm::dvec2(screen[(r + 1) * (grid_.columns + 3) + c + 1]) / kStateUnitsPerPixel);
  return out;
}

cv::Mat CellCost::covered_by_head(std::span<const glm::ivec3> vertices, cv::Size size) const {
  const int per_sample = kScreenPerPixel * observations_.factor();
  std::vector<cv::Point> outline;
  for (const std::uint16_t v : generic_head().outline)
    outline.emplace_back(vertices[v].x / per_sample, vertices[v].y / per_sample);
  cv::Mat covered = cv::Mat::zeros(size, CV_8U);
  cv::fillPoly(covered, std::vector<std::vector<cv::Point>>{outline}, cv::Scalar(255));
  return covered;
}

CellCost::Later CellCost::later_picture(const Setup& setup, const Geometry& geometry,
                                        const SurroundObservations::Observation& observation) const {
  Later later{&observation.luma, {}, {}};
  const std::array<MapLabel, 3> wholly = {MapLabel{kFollowOne, 0}, {0, kFollowOne}, {0, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    const SceneGeometry scene(setup, geometry, uniform_map(grid_, wholly[i]), observations_.first().state);
    later.displacement[i] = without_margin(scene.screen_mesh(observation.state).surround);
    for (std::size_t k = 0; k < points_.size(); ++k)
      later.displacement[i][k] =
          (later.displacement[i][k] - points_[k]) / static_cast<double>(observations_.factor());
    if (i == 0) later.hidden = covered_by_head(scene.project_vertices(observation.state), later.luma->size());
  }
  return later;
}

glm::dvec2 CellCost::displacement(const Later& later, std::size_t point, const MapLabel& label) {
  const double h = label.head / static_cast<double>(kFollowOne),
               b = label.body / static_cast<double>(kFollowOne);
  const glm::dvec2 ground = later.displacement[2][point];
  const glm::dvec2 similar = ground + b * (later.displacement[1][point] - ground);
  return similar + h * (later.displacement[0][point] - similar);
}

CellCost::Cell CellCost::cell_at(int column, int row) const {
  const auto factor = static_cast<double>(observations_.factor());
  const glm::dvec2 first = points_.front() / factor, last = points_.back() / factor;
  const glm::dvec2 size = (last - first) / glm::dvec2(grid_.columns, grid_.rows);
  const glm::dvec2 low = first + glm::dvec2(column, row) * size;
  return {low, low + size};
}

std::size_t CellCost::index_of(int column, int row) const {
  return static_cast<std::size_t>(row + 1) * static_cast<std::size_t>(grid_.columns + 2) +
         static_cast<std::size_t>(column + 1);
}

std::vector<CellCost::CellSamples> CellCost::samples_of_first() const {
  const auto factor = static_cast<double>(observations_.factor());
  const glm::vec2 begin(points_.front() / factor), end(points_.back() / factor);
  std::vector<CellSamples> out(index_of(grid_.columns, grid_.rows) + 1);
  for (int row = -1; row <= grid_.rows; ++row)
    for (int column = -1; column <= grid_.columns; ++column) {
      const Cell cell = cell_at(column, row);
      const glm::vec2 low(cell.low), size(cell.high - cell.low);
      CellSamples& samples = out[index_of(column, row)];
      for (std::size_t k = 0; k < kCellSamples; ++k) {
        const glm::vec2 from =
            low + size * glm::vec2(share(k % kSamplesAcrossCell), share(k / kSamplesAcrossCell));
        samples[k] = value(observations_.first().luma,
                           {std::clamp(from.x, begin.x, end.x), std::clamp(from.y, begin.y, end.y)});
      }
    }
  return out;
}

double CellCost::in_picture(const Later& later, const CellSamples& first,
                            const std::array<glm::dvec2, 4>& to) {
  constexpr auto kLimit = static_cast<float>(kTruncation * kTruncation);
  const glm::vec2 picture(later.luma->cols, later.luma->rows);
  float sum = 0;
  for (std::size_t v = 0; v < kSamplesAcrossCell; ++v) {
    const float fy = share(v);
    const glm::vec2 left = glm::vec2(to[0]) * (1 - fy) + glm::vec2(to[2]) * fy,
                    right = glm::vec2(to[1]) * (1 - fy) + glm::vec2(to[3]) * fy;
    for (std::size_t u = 0; u < kSamplesAcrossCell; ++u) {
      const float fx = share(u);
      const glm::vec2 p = left * (1 - fx) + right * fx;
      if (!(p.x >= 0 && p.y >= 0 && p.x < picture.x && p.y < picture.y)) continue;
      if (later.hidden.ptr(static_cast<int>(p.y))[static_cast<int>(p.x)] != 0) continue;
      const float r = value(*later.luma, p) - first[v * kSamplesAcrossCell + u];
      sum += std::min(kLimit, r * r);
    }
  }
  return static_cast<double>(sum);
}

double CellCost::operator()(int column, int row, const std::array<MapLabel, 4>& corner) const {
  const std::array<std::size_t, 4> k = grid_.corners_of(column, row);
  const Cell cell = cell_at(column, row);
  const CellSamples& first = first_[index_of(column, row)];
  double sum = 0;
  for (const Later& later : later_) {
    std::array<glm::dvec2, 4> to;
    for (std::size_t i = 0; i < 4; ++i)
      to[i] = glm::dvec2(i % 2 == 0 ? cell.low.x : cell.high.x, i < 2 ? cell.low.y : cell.high.y) +
              displacement(later, k[i], corner[i]);
    const double area = area_ratio(to, cell.high - cell.low);
    sum += area < kMinCellArea
               ? kTruncation * kTruncation
               : in_picture(later, first, to) * area / (kSamplesAcrossCell * kSamplesAcrossCell);
  }
  return sum / static_cast<double>(later_.size());
}

}  // namespace fbs
