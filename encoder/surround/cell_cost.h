// Cost of a cell of the surround's grid under the labels of its corners.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "encoder/surround/map_grid.h"
#include "encoder/surround/surround_observations.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {

/// Squared differences that remain in the later pictures after moving the first picture's luma. Holds a
/// reference to the observations.
class CellCost {
 public:
  CellCost(const Setup& setup, const Geometry& geometry, const MapGrid& grid,
           const SurroundObservations& observations);

  /// The grid's points in the first picture, pixels.
  [[nodiscard]] std::span<const glm::dvec2> points() const { return points_; }
  /// Without later pictures every cell costs nothing.
  [[nodiscard]] bool empty() const { return later_.empty(); }

  /// Mean over the later pictures and the cell's area of the truncated squared difference, where the head
  /// does not hide it. Not when empty().
  /// @param column, row  of the cell, the margin's included
  /// @param corner       labels of its corners, row by row
  [[nodiscard]] double operator()(int column, int row, const std::array<MapLabel, 4>& corner) const;

 private:
  /// A later picture, and the displacement of grid points that follow a single layer.
  struct Later {
    const cv::Mat* luma;
    cv::Mat hidden;                                       ///< nonzero where the head is
    std::array<std::vector<glm::dvec2>, 3> displacement;  ///< with head, body, ground: work pixels
  };
  static constexpr std::size_t kCellSamples =
      static_cast<std::size_t>(surround::kSamplesAcrossCell) * surround::kSamplesAcrossCell;
  using CellSamples = std::array<float, kCellSamples>;  ///< luma, row by row

  /// A cell in the first picture, work pixels.
  struct Cell {
    glm::dvec2 low, high;
  };

  [[nodiscard]] Cell cell_at(int column, int row) const;
  [[nodiscard]] std::size_t index_of(int column, int row) const;
  [[nodiscard]] std::vector<CellSamples> samples_of_first() const;
  [[nodiscard]] Later later_picture(const Setup& setup, const Geometry& geometry,
                                    const SurroundObservations::Observation& observation) const;
  [[nodiscard]] cv::Mat covered_by_head(std::span<const glm::ivec3> vertices, cv::Size size) const;
  [[nodiscard]] std::vector<glm::dvec2> without_margin(const std::vector<glm::ivec2>& screen) const;
  [[nodiscard]] static glm::dvec2 displacement(const Later& later, std::size_t point, const MapLabel& label);
  [[nodiscard]] static double in_picture(const Later& later, const CellSamples& first,
                                         const std::array<glm::dvec2, 4>& to);

  MapGrid grid_;
  const SurroundObservations& observations_;
  std::vector<glm::dvec2> points_;
  std::vector<Later> later_;
  std::vector<CellSamples> first_;  ///< of each cell in the first picture, by index_of()
};

}  // namespace fbs
