#include "encoder/surround/map_labelling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

MapLabelling::MapLabelling(const MapGrid& grid, const CellCost& cell_cost, std::vector<glm::dvec2> prior)
    : grid_(grid),
      cell_cost_(cell_cost),
      prior_(std::move(prior)),
      labels_(grid.points()),
      visited_(grid.points(), 0),
      changed_(grid.points(), 0) {}

std::vector<MapLabel> MapLabelling::solve() {
  start();
  if (!cell_cost_.empty())
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      if (!improve()) break;
  return std::move(labels_);
}

double MapLabelling::prior_cost(std::size_t k, const MapLabel& label) const {
  const double rest = (kFollowOne - label.head) / static_cast<double>(kFollowOne);
  return kPlacePrior * (std::abs(label.head - prior_[k].x) + rest * std::abs(label.body - prior_[k].y));
}

double MapLabelling::smoothness(std::size_t k, const MapLabel& label) const {
  double sum = 0;
  grid_.for_neighbours(k, [&](std::size_t i) { sum += distance(label, labels_[i]); });
  return kSmoothness * sum;
}

std::vector<double> MapLabelling::uniform_costs() const {
  const std::size_t n = map_labels().size();
  std::vector<double> costs(labels_.size() * n, 0.0);
  if (cell_cost_.empty()) return costs;
  for (int r = -1; r <= grid_.rows; ++r)
    for (int c = -1; c <= grid_.columns; ++c)
      for (std::size_t i = 0; i < n; ++i) {
        const MapLabel l = map_labels()[i];
        const double cost = cell_cost_(c, r, {l, l, l, l});
        for (const std::size_t k : grid_.corners_of(c, r)) costs[k * n + i] += cost / 2;
      }
  return costs;
}

void MapLabelling::start() {
  const std::size_t n = map_labels().size();
  const std::vector<double> costs = uniform_costs();
  for (int sweep = 0; sweep < kStartSweeps; ++sweep) {
    for (std::size_t k = 0; k < labels_.size(); ++k) {
      double least = 1e30;
      MapLabel best{};
      for (std::size_t i = 0; i < n; ++i) {
        const MapLabel l = map_labels()[i];
        const double cost = costs[k * n + i] + prior_cost(k, l) + (sweep > 0 ? smoothness(k, l) : 0);
        if (cost < least) {
          least = cost;
          best = l;
        }
      }
      labels_[k] = best;
    }
  }
}

double MapLabelling::cost_of(std::size_t k, const MapLabel& label, double enough) {
  const int c = static_cast<int>(k % grid_.stride()), r = static_cast<int>(k / grid_.stride());
  const MapLabel was = std::exchange(labels_[k], label);
  double sum = prior_cost(k, label) + smoothness(k, label);
  for (int row = r - 1; row <= r; ++row)
    for (int column = c - 1; column <= c && sum < enough; ++column) {
      const auto i = grid_.corners_of(column, row);
      sum += cell_cost_(column, row, {labels_[i[0]], labels_[i[1]], labels_[i[2]], labels_[i[3]]});
    }
  labels_[k] = was;
  return sum;
}

MapLabel MapLabelling::best_label(std::size_t k) {
  double least = cost_of(k, labels_[k], std::numeric_limits<double>::infinity()) - 1e-9;
  MapLabel best = labels_[k];
  for (const MapLabel& l : map_labels()) {
    if (distance(l, labels_[k]) > kMaxLabelChange && !has_neighbour(k, l)) continue;
    if (const double now = cost_of(k, l, least); now < least) {
      least = now;
      best = l;
    }
  }
  return best;
}

bool MapLabelling::improve() {
  bool changed = false;
  for (std::size_t k = 0; k < labels_.size(); ++k) {
    if (changed_near(k) < visited_[k]) continue;
    visited_[k] = ++visits_;
    const MapLabel best = best_label(k);
    if (best == labels_[k]) continue;
    changed = true;
    changed_[k] = visits_;
    labels_[k] = best;
  }
  return changed;
}

int MapLabelling::changed_near(std::size_t k) const {
  const int column = static_cast<int>(k % grid_.stride()), row = static_cast<int>(k / grid_.stride());
  int last = 0;
  for (int r = std::max(0, row - 1); r <= std::min(grid_.rows, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(grid_.columns, column + 1); ++c)
      last = std::max(last, changed_[r * grid_.stride() + c]);
  return last;
}

bool MapLabelling::has_neighbour(std::size_t k, const MapLabel& label) const {
  bool found = false;
  grid_.for_neighbours(k, [&](std::size_t i) { found = found || labels_[i] == label; });
  return found;
}

}  // namespace fbs
