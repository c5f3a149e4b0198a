#include "encoder/find/elastic_fit.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/find_tuning.h"

namespace fbs {

using namespace find_tuning;

namespace {

double area(const FrontPoints& p, const HeadTriangle& t) {
  const glm::dvec2 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]];
  return a.x * b.y - a.y * b.x;
}

bool folds(const WireFrame& frame, const FrontPoints& now, const FrontPoints& scaled) {
  return std::ranges::any_of(
      frame.triangles, [&](const HeadTriangle& t) { return area(now, t) < kMinArea * area(scaled, t); });
}

double length(double v) {
  return std::abs(v);
}
double length(glm::dvec2 v) {
  return std::hypot(v.x, v.y);
}

/// One elastic iteration: every vertex moves by the mean of the forces, each weighted with the Gaussian of
/// its edge distance; far from all marks the motion fades out.
template <class T>
std::vector<T> pull(const std::vector<T>& now, const std::vector<std::optional<T>>& target,
                    std::span<const float> distances, double sigma) {
  std::vector<T> moved = now;
  for (std::size_t v = 0; v < now.size(); ++v) {
    T sum(0);
    double weight = 0;
    for (std::size_t m = 0; m < now.size(); ++m) {
      if (!target[m]) continue;
      const double d = distances[v * now.size() + m] / sigma;
      const double g = std::exp(-0.5 * d * d);
      sum += g * (*target[m] - now[m]);
      weight += g;
    }
    moved[v] += sum / std::max(1.0, weight);
  }
  return moved;
}

template <class T>
double largest_force(const std::vector<T>& now, const std::vector<std::optional<T>>& target) {
  double largest = 0;
  for (std::size_t v = 0; v < now.size(); ++v)
    if (target[v]) largest = std::max(largest, length(*target[v] - now[v]));
  return largest;
}

/// Moves from `now` towards `moved` as far as no triangle folds; nothing when even a little folds one.
std::optional<FrontPoints> without_folds(const WireFrame& frame, const FrontPoints& now,
                                         const FrontPoints& moved, const FrontPoints& scaled) {
  double reach = 1;
  FrontPoints next = moved;
  while (folds(frame, next, scaled) && reach > kMinReach) {
    reach /= 2;
    for (std::size_t v = 0; v < now.size(); ++v) next[v] = now[v] + reach * (moved[v] - now[v]);
  }
  if (folds(frame, next, scaled)) return std::nullopt;
  return next;
}

/// Iterates until the marks are reached, or until `accepted` refuses an iteration: marks that contradict the
/// mesh stop it early.
/// @param accepted  (now, moved) -> optional with the part of `moved` that is accepted
/// @return number of iterations
template <class T, class Accept>
int iterate(std::span<const float> distances, const std::vector<std::optional<T>>& target,
            std::vector<T>& points, Accept&& accepted) {
  double sigma = kFirstElasticSigma;
  int iterations = 0;
  for (; iterations < kMaxElasticIterations && largest_force(points, target) > kAtRest; ++iterations) {
    std::optional<std::vector<T>> next = accepted(points, pull(points, target, distances, sigma));
    if (!next) break;
    points = std::move(*next);
    sigma = std::max(kLastElasticSigma, sigma * kElasticDecay);
  }
  return iterations;
}

}  // namespace

ElasticFit fit_elastically(const WireFrame& frame, std::span<const float> distances,
                           const FrontPoints& scaled, const FrontMarks& target) {
  ElasticFit out{scaled, 0};
  out.iterations =
      iterate(distances, target, out.points, [&](const FrontPoints& now, const FrontPoints& moved) {
        return without_folds(frame, now, moved, scaled);
      });
  return out;
}

Depths fit_elastically(std::span<const float> distances, const Depths& scaled, const DepthMarks& target) {
  Depths out = scaled;
  iterate(distances, target, out,
          [](const Depths&, Depths moved) { return std::optional(std::move(moved)); });
  return out;
}

}  // namespace fbs
