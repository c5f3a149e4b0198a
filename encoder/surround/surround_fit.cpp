#include "encoder/surround/surround_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "encoder/model/pose.h"
#include "encoder/surround/cell_cost.h"
#include "encoder/surround/layer_membership.h"
#include "encoder/surround/map_labelling.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {
namespace {

MapGrid grid_of(const VideoFormat& format) {
  const double cell = std::max(format.width, format.height) / surround::kCellsAlongLongSide;
  return {std::max(2, static_cast<int>(std::lround(format.width / cell))),
          std::max(2, static_cast<int>(std::lround(format.height / cell)))};
}

/// Shares of head and body at a place, quarters.
glm::dvec2 prior_at(const Pose& seen, glm::dvec2 place) {
  const LayerShares layers = layers_by_place(seen, place);
  const auto head = static_cast<double>(layers[kHeadLayer]), body = static_cast<double>(layers[kBodyLayer]);
  return {kFollowOne * head, kFollowOne * body / std::max(0.01, 1.0 - head)};
}

}  // namespace

SurroundMap fit_surround(const Setup& setup, const Geometry& geometry,
                         const SurroundObservations& observations) {
  const MapGrid grid = grid_of(setup.format);
  const CellCost cell_cost(setup, geometry, grid, observations);
  const Pose seen = pose_of(observations.first().state);
  std::vector<glm::dvec2> prior;
  for (const glm::dvec2 place : cell_cost.points()) prior.push_back(prior_at(seen, place));
  SurroundMap map = uniform_map(grid, {});
  const std::vector<MapLabel> labels = MapLabelling(grid, cell_cost, std::move(prior)).solve();
  for (std::size_t k = 0; k < labels.size(); ++k) {
    map.head[k] = labels[k].head;
    map.body[k] = labels[k].body;
  }
  return map;
}

}  // namespace fbs
