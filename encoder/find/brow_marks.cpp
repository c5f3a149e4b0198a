#include "encoder/find/brow_marks.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "encoder/find/evidence.h"

namespace fbs {

using namespace find_tuning;

namespace {

constexpr int kPoints = ibug::kBrowPoints;
using Heights = std::array<double, kPoints>;

/// -0.5..0.5 along the brow.
double along(int i) {
  return static_cast<double>(i) / (kPoints - 1) - 0.5;
}

/// A parabola through heights, bent as usual unless they insist.
Heights smoothed(const Heights& ys, const Heights& usual) {
  cv::Matx33d a = cv::Matx33d::zeros();
  cv::Vec3d b(0, 0, 0);
  for (int i = 0; i < kPoints; ++i) {
    const double t = along(i);
    const cv::Vec3d row(1, t, t * t);
    a += row * row.t();
    b += row * ys[i];
  }
  const double usual_bend = 0.5 * (usual.front() + usual.back()) - usual[kPoints / 2];
  a(2, 2) += kBrowBendPrior;
  b[2] += kBrowBendPrior * usual_bend * 4;  // t^2 is a quarter at the ends
  const cv::Vec3d c = a.inv() * b;
  Heights out{};
  for (int i = 0; i < kPoints; ++i) {
    const double t = along(i);
    out[i] = c[0] + c[1] * t + c[2] * t * t;
  }
  return out;
}

/// y of the brow's dark ridge at places: first the brow as a whole, then each place.
Heights find_ridge(const FaceFrame& f, const Heights& xs, const Heights& usual) {
  const double lift = search(kBrowLift, 0, [&](double d) {
    double sum = 0;
    for (int i = 0; i < kPoints; ++i)
      sum += std::min(kMaxBrowValley, f.valley(xs[i], usual[i] + d, kBrowLiftReach));
    return sum / kPoints / kBrowLiftPerEvidence;
  });
  Heights ys{};
  for (int i = 0; i < kPoints; ++i)
    ys[i] = search(kBrowPoint, usual[i] + lift,
                   [&](double y) { return f.valley(xs[i], y, kBrowPointReach) / kBrowPointPerEvidence; });
  return smoothed(ys, usual);
}

}  // namespace

std::array<glm::dvec2, kPoints> find_brow(const FaceFrame& face, const FaceYaw& yaw, int first) {
  Heights xs{}, ridge{};
  for (int i = 0; i < kPoints; ++i) {
    const glm::dvec2 usual = yaw.seen(generic_landmark(first + i));
    xs[i] = usual.x;
    ridge[i] = usual.y + kBrowHalfWidth;
  }
  const Heights ys = find_ridge(face, xs, ridge);
  std::array<glm::dvec2, kPoints> out;
  for (int i = 0; i < kPoints; ++i) out[i] = {xs[i], ys[i] - kBrowHalfWidth};
  return out;
}

}  // namespace fbs
