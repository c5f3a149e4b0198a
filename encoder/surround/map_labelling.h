// Labels the points of the surround's map by iterated conditional modes (Besag 1986).
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "encoder/surround/cell_cost.h"
#include "encoder/surround/map_grid.h"

namespace fbs {

/// Minimises the cells' costs plus penalties for neighbours that differ and for departures from a spatial
/// prior.
class MapLabelling {
 public:
  /// @param prior  shares of head and body of each point, quarters
  MapLabelling(const MapGrid& grid, const CellCost& cell_cost, std::vector<glm::dvec2> prior);

  /// First as if each point's surroundings followed it, then on the cells as they are drawn.
  [[nodiscard]] std::vector<MapLabel> solve();

 private:
  [[nodiscard]] double prior_cost(std::size_t k, const MapLabel& label) const;
  [[nodiscard]] double smoothness(std::size_t k, const MapLabel& label) const;
  /// Cells' cost for each point and label, as if the point's four cells had the label. [point * labels +
  /// label]
  [[nodiscard]] std::vector<double> uniform_costs() const;
  void start();
  /// One sweep on the cells as they are drawn; false when nothing changed.
  bool improve();
  /// Prior, smoothness and the four cells' cost when a point changes to a label.
  /// @param enough  a cost of at least this need not be exact, which saves most of the cells
  [[nodiscard]] double cost_of(std::size_t k, const MapLabel& label, double enough);
  [[nodiscard]] MapLabel best_label(std::size_t k);
  /// The visit in which a point or one around it last changed.
  [[nodiscard]] int changed_near(std::size_t k) const;
  [[nodiscard]] bool has_neighbour(std::size_t k, const MapLabel& label) const;

  MapGrid grid_;
  const CellCost& cell_cost_;
  std::vector<glm::dvec2> prior_;
  std::vector<MapLabel> labels_;
  int visits_ = 0;
  std::vector<int> visited_, changed_;  ///< the visit in which a point was last seen, and last changed
};

}  // namespace fbs
