#include "encoder/fit/lid_search.h"

#include "encoder/fit/fit_tuning.h"

namespace fbs {
namespace {

constexpr std::size_t kCandidates = std::size(kLidClosings) + 1;  // the last: unchanged

}  // namespace

LidSearch::LidSearch(const Geometry& geometry, const SamplePoints& points)
    : lids_{lid_of(geometry, points, FeatureId::kUpperLidRight, 40),
            lid_of(geometry, points, FeatureId::kUpperLidLeft, 46)} {}

LidSearch::Lid LidSearch::lid_of(const Geometry& geometry, const SamplePoints& points, FeatureId id,
                                 std::size_t lower_landmark) {
  const Feature& f = feature(id);
  double upper = 0, lower = 0;
  for (const FeatureVertex& fv : f.vertices) upper += geometry.positions[fv.vertex].y;
  for (const std::size_t k : {lower_landmark, lower_landmark + 1})
    lower += geometry.positions[vertex_of_landmark(k)].y;
  // Together, both free control points of the cubic have two thirds of the weight at its vertices.
  const double travel = 1.5 * (0.5 * (lower - upper) + kLidOverlap * kUnitsPerEyeDistance);
  return {f.first_control, travel, MovedPoints(points, f.first_control, 2)};
}

Fit LidSearch::Lid::closed(std::size_t candidate, Fit start) const {
  if (candidate < std::size(kLidClosings))
    for (std::size_t c = first_control; c < first_control + 2; ++c)
      start.offsets[c] = {0, kLidClosings[candidate] * travel};
  return start;
}

double LidSearch::Lid::closing(const Fit& fit) const {
  return 0.5 * (fit.offsets[first_control].y + fit.offsets[first_control + 1].y) / travel;
}

Fit LidSearch::best(const Comparison& comparison, const Fit& start) const {
  if (!comparison.columns.has(lids_[0].first_control)) return start;
  std::array<std::array<double, kCandidates>, 2> differences{}, closing{};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    for (std::size_t i = 0; i < kCandidates; ++i) {
      const Fit fit = lids_[eye].closed(i, start);
      differences[eye][i] = lids_[eye].moved.difference(comparison, fit);
      closing[eye][i] = lids_[eye].closing(fit);
    }
  }
  double least = 1e30;
  std::array<std::size_t, 2> chosen{};
  for (std::size_t i = 0; i < kCandidates; ++i) {
    for (std::size_t j = 0; j < kCandidates; ++j) {
      const double apart = closing[0][i] - closing[1][j];
      const double cost = differences[0][i] + differences[1][j] + kLidsApartCost * apart * apart;
      if (cost < least) {
        least = cost;
        chosen = {i, j};
      }
    }
  }
  return lids_[1].closed(chosen[1], lids_[0].closed(chosen[0], start));
}

}  // namespace fbs
