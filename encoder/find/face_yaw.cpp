#include "encoder/find/face_yaw.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/evidence.h"
#include "encoder/find/landmarks.h"

namespace fbs {

using namespace find_tuning;

namespace {

/// Luma less that of its neighbourhood: what light falling from a side leaves.
double detail(const FaceFrame& f, double x, double y) {
  return f.luma(x, y) - 0.25 * (f.luma(x - kDetailReach, y) + f.luma(x + kDetailReach, y) +
                                f.luma(x, y - kDetailReach) + f.luma(x, y + kDetailReach));
}

/// A part of the face that is symmetric about the midline: between two heights, so far to either side.
struct SymmetricPart {
  double top, bottom, half;
};
constexpr SymmetricPart kNose = {0.25, 0.95, 0.4}, kMouth = {0.9, 1.4, 0.6};

/// How alike left and right of an axis are, -1..1.
/// @param axis_x  x of the axis at a height y
double symmetry(const FaceFrame& f, const SymmetricPart& part, const std::function<double(double)>& axis_x) {
  double n = 0, sum = 0, square = 0, product = 0;
  for (double y = part.top; y <= part.bottom; y += kSymmetryGrid) {
    const double x = axis_x(y);
    for (double d = kSymmetryGrid; d <= part.half; d += kSymmetryGrid) {
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

double nose_evidence(const FaceFrame& f, const FaceYaw& yaw) {
  const glm::dvec3 upper = generic_landmark(ibug::kNoseBridge + 1), tip = generic_landmark(ibug::kNoseTip),
                   base = generic_landmark(ibug::kNoseBase);
  return kSymmetryEvidence * symmetry(f, kNose, [&](double y) {
           const double z =
               y < tip.y ? upper.z + (tip.z - upper.z) * (y - upper.y) / (tip.y - upper.y) : base.z;
           return yaw.midline(z);
         });
}

double mouth_evidence(const FaceFrame& f, const FaceYaw& yaw) {
  const double z = generic_landmark(ibug::kUpperLipInner).z;
  return kSymmetryEvidence * symmetry(f, kMouth, [&](double) { return yaw.midline(z); });
}

/// Face borders left and right, the same distance from the midline.
double side_evidence(const FaceFrame& f, const FaceYaw& yaw) {
  double sum = 0;
  for (const int k : {1, 2, 3}) {
    const glm::dvec3 g = generic_landmark(mirrored_jaw(k));
    double best = -1e30;
    for (double wide = kMinFaceWidth; wide <= kMaxFaceWidth; wide += 1.0 / 64) {
      double step = 0;
      for (const int side : {-1, 1})
        step += border_evidence(f, yaw.shift + side * wide * g.x + yaw.tangent * g.z, g.y);
      const double d = (wide - 1) / kWidthSigma;
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
  for (double shift = -kMaxYawShift; shift <= kMaxYawShift; shift += kYawStep) {
    for (double tangent = -kMaxYawTangent; tangent <= kMaxYawTangent; tangent += kYawStep) {
      const FaceYaw yaw = {tangent, shift};
      const double t = tangent / kYawSigma, d = shift / kYawShiftSigma;
      const double score = kNoseWeight * nose_evidence(f, yaw) + kMouthWeight * mouth_evidence(f, yaw) +
                           kSideWeight * side_evidence(f, yaw) - t * t - d * d;
      if (score > best_score) {
        best_score = score;
        best = yaw;
      }
    }
  }
  return best;
}

}  // namespace fbs
