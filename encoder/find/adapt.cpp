#include "encoder/find/adapt.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "encoder/find/landmarks.h"
#include "encoder/image/robust.h"

namespace fbs {
namespace {

using Points = std::array<glm::dvec2, kVertexCount>;

constexpr double kUnits = kUnitsPerEyeDistance;
constexpr int kMaxIterations = 80;
constexpr double kFirstSigma = 0.55, kLastSigma = 0.035;  // eye distances
constexpr double kSigmaDecay = 0.93;
constexpr double kAtRest = 1.0 / 512;  // largest force that counts as rest, eye distances
constexpr double kMostTurn = 0.6;      // tangent of the yaw that marks may show
constexpr double kLeastArea = 0.05;    // of a triangle's own area on the scaled head

/// How far a vertex of the generic head lies behind its eyes, eye distances.
double behind_eyes(std::size_t v) {
  return generic_head().vertices[v].position.z / kUnits - generic_eye_depth();
}

double area(const Points& p, const HeadTriangle& t) {
  const auto at = [&](int i) { return p[t[i]]; };
  const glm::dvec2 a = at(1) - at(0), b = at(2) - at(0);
  return a.x * b.y - a.y * b.x;
}

bool folds(const Points& now, const Points& scaled) {
  for (const HeadTriangle& t : generic_head().triangles)
    if (area(now, t) < kLeastArea * area(scaled, t)) return true;
  return false;
}

/// The turn that the marks show: tangent of the yaw, positive towards the picture's left, and width, by
/// robust least squares of x = width * generic x + tangent * depth behind the eyes.
struct Turn {
  double tangent = 0, width = 1;
};
Turn turn_of(const std::array<std::optional<glm::dvec2>, kVertexCount>& target) {
  constexpr double kSigma = 0.06, kUsual = 0.6;  // eye distances of a mark; of the tangent before looking
  Turn turn;
  for (int iteration = 0; iteration < 5; ++iteration) {
    double xx = 1, xz = 0, zz = kSigma * kSigma / (kUsual * kUsual), xt = 1, zt = 0;
    for (std::size_t v = 0; v < kVertexCount; ++v) {
      if (!target[v]) continue;
      const double x = generic_head().vertices[v].position.x / kUnits, z = behind_eyes(v);
      const double r = (target[v]->x - turn.width * x - turn.tangent * z) / kSigma;
      const double w = cauchy_weight(r * r);
      xx += w * x * x;
      xz += w * x * z;
      zz += w * z * z;
      xt += w * x * target[v]->x;
      zt += w * z * target[v]->x;
    }
    const double det = xx * zz - xz * xz;
    turn.width = std::clamp((zz * xt - xz * zt) / det, 0.7, 1.4);
    turn.tangent = std::clamp((xx * zt - xz * xt) / det, -kMostTurn, kMostTurn);
  }
  return turn;
}

/// Scale of one axis that brings the generic positions nearest to the marked ones, within anatomical limits.
double axis_scale(const Points& generic, const std::array<std::optional<glm::dvec2>, kVertexCount>& target,
                  int axis) {
  double num = 0, den = 0;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (!target[v]) continue;
    num += (*target[v])[axis] * generic[v][axis];
    den += generic[v][axis] * generic[v][axis];
  }
  return den > 0 ? std::clamp(num / den, 0.7, 1.4) : 1.0;
}

/// One elastic iteration: every vertex moves by the mean of the forces, each weighted with the Gaussian of
/// its edge distance; far from all marks the motion fades out.
Points pull(const Points& now, const std::array<std::optional<glm::dvec2>, kVertexCount>& target,
            double sigma) {
  const std::vector<float>& distance = edge_distances();
  Points moved = now;
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

double largest_force(const Points& now, const std::array<std::optional<glm::dvec2>, kVertexCount>& target) {
  double largest = 0;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    if (target[v]) largest = std::max(largest, std::hypot(target[v]->x - now[v].x, target[v]->y - now[v].y));
  return largest;
}

}  // namespace

const std::vector<float>& edge_distances() {
  static const std::vector<float> table = [] {
    constexpr std::size_t n = kVertexCount;
    std::vector<float> d(n * n, std::numeric_limits<float>::infinity());
    for (std::size_t v = 0; v < n; ++v) d[v * n + v] = 0;
    const GenericHead& head = generic_head();
    for (const HeadTriangle& t : head.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto a = static_cast<std::size_t>(t[i]), b = static_cast<std::size_t>(t[(i + 1) % 3]);
        const glm::dvec3 e = glm::dvec3(head.vertices[a].position - head.vertices[b].position) / kUnits;
        const auto length = static_cast<float>(std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z));
        d[a * n + b] = d[b * n + a] = length;
      }
    }
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          d[i * n + j] = std::min(d[i * n + j], d[i * n + k] + d[k * n + j]);
    return d;
  }();
  return table;
}

Result<AdaptedHead> adapt_head(const Marks& marks) {
  const auto eyes = marks.eyes();
  if (!eyes) return fail(ErrorCode::kDegenerateInput, "an eye has no mark");
  const glm::dvec2 across = (*eyes)[1] - (*eyes)[0];
  const double eye_distance = std::hypot(across.x, across.y);
  if (eye_distance < 4) return fail(ErrorCode::kDegenerateInput, "the eyes are less than 4 pixels apart");

  AdaptedHead out;
  out.pose.roll = std::atan2(across.y, across.x);
  out.pose.log2_scale = std::log2(eye_distance);
  out.pose.shift = 0.5 * ((*eyes)[0] + (*eyes)[1]);

  // Marks seen from the front, eye distances: a rotation by -roll, then the turn is undone.
  const double c = std::cos(out.pose.roll) / eye_distance, s = std::sin(out.pose.roll) / eye_distance;
  std::array<std::optional<glm::dvec2>, kVertexCount> target;
  Points generic;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::ivec3 p = generic_head().vertices[v].position;
    generic[v] = glm::dvec2(p.x, p.y) / kUnits;
    if (!marks.vertex[v]) continue;
    const glm::dvec2 d = *marks.vertex[v] - out.pose.shift;
    target[v] = glm::dvec2(c * d.x + s * d.y, -s * d.x + c * d.y);
  }
  // A turn by a yaw narrows x to its cosine, the distance between the eyes with it, so that seen in eye
  // distances x keeps its size, depth adds to it by the tangent and y grows. The head turns about its own
  // axis, and the eyes stay where they are seen.
  const Turn turn = turn_of(target);
  const double depth = 0.5 * (turn.width + axis_scale(generic, target, 1));
  out.pose.yaw = std::atan(turn.tangent / depth);
  const double cosine = std::cos(out.pose.yaw);
  out.pose.log2_scale -= std::log2(cosine);
  const double aside = eye_distance * turn.tangent * generic_eye_depth();
  out.pose.shift -= aside * glm::dvec2(std::cos(out.pose.roll), std::sin(out.pose.roll));
  for (std::size_t v = 0; v < kVertexCount; ++v)
    if (target[v]) target[v] = {target[v]->x - turn.tangent * behind_eyes(v), target[v]->y * cosine};
  const double sx = axis_scale(generic, target, 0), sy = axis_scale(generic, target, 1);
  Points now;
  for (std::size_t v = 0; v < kVertexCount; ++v) now[v] = generic[v] * glm::dvec2(sx, sy);
  const Points scaled = now;

  double sigma = kFirstSigma;
  for (; out.iterations < kMaxIterations && largest_force(now, target) > kAtRest; ++out.iterations) {
    const Points moved = pull(now, target, sigma);
    double reach = 1;
    Points next = moved;
    while (folds(next, scaled) && reach > 1.0 / 64) {
      reach /= 2;
      for (std::size_t v = 0; v < kVertexCount; ++v) next[v] = now[v] + reach * (moved[v] - now[v]);
    }
    if (folds(next, scaled)) break;  // marks that contradict the mesh: what was reached stays
    now = next;
    sigma = std::max(kLastSigma, sigma * kSigmaDecay);
  }

  for (std::size_t v = 0; v < kVertexCount; ++v)
    out.geometry.positions[v] = glm::ivec3(std::lround(now[v].x * kUnits), std::lround(now[v].y * kUnits),
                                           std::lround(generic_head().vertices[v].position.z * depth));
  return out;
}

}  // namespace fbs
