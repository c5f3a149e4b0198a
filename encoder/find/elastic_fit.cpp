#include "encoder/find/elastic_fit.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/edge_distances.h"
#include "encoder/find/find_tuning.h"

namespace fbs {

using namespace find_tuning;

namespace {

double area(const FrontPoints& p, const HeadTriangle& t) {
  const glm::dvec2 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]];
  return a.x * b.y - a.y * b.x;
}

bool folds(const FrontPoints& now, const FrontPoints& scaled) {
  for (const HeadTriangle& t : generic_head().triangles)
    if (area(now, t) < kMinArea * area(scaled, t)) return true;
  return false;
}

/// One elastic iteration: every vertex moves by the mean of the forces, each weighted with the Gaussian of
/// its edge distance; far from all marks the motion fades out.
FrontPoints pull(const FrontPoints& now, const FrontMarks& target, double sigma) {
  const std::vector<float>& distance = edge_distances();
  FrontPoints moved = now;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    glm::dvec2 sum(0);
    double weight = 0;
    for (std::size_t m = 0; m < kVertexCount; ++m) {
      if (!target[m]) continue;
      const double d = distance[v * kVertexCount + m] / sigma;
      const double g = std::exp(-0.5 * d * d);
      sum += g * (*target[m] - now[m]);
      weight += g;
    }
    moved[v] += sum / std::max(1.0, weight);
  }
  return moved;
}

double largest_force(const FrontPoints& now, const FrontMarks& target) {
  double largest = 0;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    if (target[v]) largest = std::max(largest, std::hypot(target[v]->x - now[v].x, target[v]->y - now[v].y));
  return largest;
}

/// As far from `now` towards `moved` as no triangle folds; nothing when even a little folds one.
std::optional<FrontPoints> without_folds(const FrontPoints& now, const FrontPoints& moved,
                                         const FrontPoints& scaled) {
  double reach = 1;
  FrontPoints next = moved;
  while (folds(next, scaled) && reach > kMinReach) {
    reach /= 2;
    for (std::size_t v = 0; v < kVertexCount; ++v) next[v] = now[v] + reach * (moved[v] - now[v]);
  }
  if (folds(next, scaled)) return std::nullopt;
  return next;
}

}  // namespace

ElasticFit fit_elastically(const FrontPoints& scaled, const FrontMarks& target) {
  ElasticFit out{scaled, 0};
  double sigma = kFirstElasticSigma;
  for (; out.iterations < kMaxElasticIterations && largest_force(out.points, target) > kAtRest;
       ++out.iterations) {
    const auto next = without_folds(out.points, pull(out.points, target, sigma), scaled);
    if (!next) break;  // marks that contradict the mesh: what was reached stays
    out.points = *next;
    sigma = std::max(kLastElasticSigma, sigma * kElasticDecay);
  }
  return out;
}

}  // namespace fbs
