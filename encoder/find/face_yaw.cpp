#include "encoder/find/face_yaw.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/landmarks.h"

namespace fbs {
namespace {

constexpr double kMostTurn = 0.5, kMostShift = 4.0 / 64;
constexpr double kStep = 1.0 / 64;
// That cost as much as evidence of one.
constexpr double kUsualTurn = 0.4, kUsualShift = 0.06, kUsualWidth = 0.15;
// The sides move most by a turn, and say most.
constexpr double kNoseWeight = 1.5, kMouthWeight = 1, kSideWeight = 4;

/// Luma less that of its neighbourhood: what light falling from a side leaves.
double detail(const FaceFrame& f, double x, double y) {
  constexpr double kReach = 0.14;
  return f.luma(x, y) - 0.25 * (f.luma(x - kReach, y) + f.luma(x + kReach, y) + f.luma(x, y - kReach) +
                                f.luma(x, y + kReach));
}

/// How alike left and right of an axis are, -1..1, in a window about it.
/// @param axis_x  x of the axis at a height y
double symmetry(const FaceFrame& f, double top, double bottom, double half,
                const std::function<double(double)>& axis_x) {
  constexpr double kGrid = 1.0 / 32;
  double n = 0, sum = 0, square = 0, product = 0;
  for (double y = top; y <= bottom; y += kGrid) {
    const double x = axis_x(y);
    for (double d = kGrid; d <= half; d += kGrid) {
      const double l = detail(f, x - d, y), r = detail(f, x + d, y);
      n += 2;
      sum += l + r;
      square += l * l + r * r;
      product += 2 * l * r;
    }
  }
  const double mean = sum / n, variance = square / n - mean * mean;
  return variance > 1 ? (product / n - mean * mean) / variance : 0;
}

double nose_evidence(const FaceFrame& f, double turn, double shift) {
  const glm::dvec3 upper = generic_landmark(28), tip = generic_landmark(30), base = generic_landmark(33);
  return 3 * symmetry(f, 0.25, 0.95, 0.4, [&](double y) {
           const double z =
               y < tip.y ? upper.z + (tip.z - upper.z) * (y - upper.y) / (tip.y - upper.y) : base.z;
           return shift + turn * z;
         });
}

double mouth_evidence(const FaceFrame& f, double turn, double shift) {
  const double z = generic_landmark(62).z;
  return 3 * symmetry(f, 0.9, 1.4, 0.6, [&](double) { return shift + turn * z; });
}

/// Face borders left and right, the same distance from a middle at x.
double side_evidence(const FaceFrame& f, double turn, double shift) {
  double sum = 0;
  for (const int k : {1, 2, 3}) {
    const glm::dvec3 g = generic_landmark(16 - k);
    double best = -1e30;
    for (double wide = 0.85; wide <= 1.2; wide += 1.0 / 64) {
      double step = 0;
      for (const int side : {-1, 1}) {
        const double x = shift + side * wide * g.x + turn * g.z;
        step += std::min(2.0, std::abs(f.luma(x - 0.06, g.y) - f.luma(x + 0.06, g.y)) / 20 +
                                  std::abs(f.red(x - 0.08, g.y) - f.red(x + 0.08, g.y)) / 8);
      }
      const double d = (wide - 1) / kUsualWidth;
      best = std::max(best, 0.5 * step - d * d);
    }
    sum += best / 3;
  }
  return sum;
}

}  // namespace

FaceYaw estimate_yaw(const FaceFrame& f) {
  FaceYaw best;
  double best_score = -1e30;
  for (double shift = -kMostShift; shift <= kMostShift; shift += kStep) {
    for (double turn = -kMostTurn; turn <= kMostTurn; turn += kStep) {
      const double t = turn / kUsualTurn, d = shift / kUsualShift;
      const double score = kNoseWeight * nose_evidence(f, turn, shift) +
                           kMouthWeight * mouth_evidence(f, turn, shift) +
                           kSideWeight * side_evidence(f, turn, shift) - t * t - d * d;
      if (score > best_score) {
        best_score = score;
        best = {turn, shift};
      }
    }
  }
  return best;
}

}  // namespace fbs
