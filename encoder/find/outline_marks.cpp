#include "encoder/find/outline_marks.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/evidence.h"
#include "encoder/find/landmarks.h"

namespace fbs {

using namespace find_tuning;

namespace {

/// How much farther out or in than `usual` the face's border lies at height y: where brightness and colour
/// leave those of the cheek.
double find_side(const FaceFrame& f, int side, double y, double usual) {
  const double cheek = side * (side * usual - kCheekInside);
  const double skin = f.luma(cheek, kCheekY), skin_red = f.red(cheek, kCheekY);
  return search(kSide, 0, [&](double d) {
    const double x = usual + side * d;
    const double inside = std::abs(f.luma(x - side * kInsideReach, y) - skin) / kInsideLuma +
                          std::abs(f.red(x - side * kInsideReach, y) - skin_red) / kInsideRed;
    return border_evidence(f, x, y) - kInsideCost * std::min(kMaxInside, inside);
  });
}

double find_chin(const FaceFrame& f, const MouthMarks& mouth, double middle) {
  const double open = mouth.lips.inner_bottom - mouth.lips.inner_top;
  const double usual = mouth.lips.inner_top + kChinBelowMouth + kChinPerOpening * open;
  return search(kChin, usual, [&](double y) {
    const double edge = mean_over(middle, kChinHalf, [&](double x) {
      return std::abs(f.luma(x, y - kChinReach) - f.luma(x, y + kChinReach));
    });
    return std::min(kMaxChinEvidence, edge / kChinPerEvidence);
  });
}

}  // namespace

JawMarks find_jaw(const FaceFrame& face, const FaceYaw& yaw, const MouthMarks& mouth) {
  const glm::dvec3 chin = generic_landmark(ibug::kChin);
  JawMarks out;
  out.stretch = find_chin(face, mouth, yaw.seen(chin).x) / chin.y;
  for (const int k : {1, 2, 3, 4}) {
    const int other = mirrored_jaw(k);
    const glm::dvec2 usual = yaw.seen(generic_landmark(k));
    const double y = usual.y * out.stretch, wide = generic_landmark(other).x;
    out.right += find_side(face, -1, y, usual.x) / wide / 4;
    out.left += find_side(face, 1, y, yaw.seen(generic_landmark(other)).x) / wide / 4;
  }
  return out;
}

glm::dvec2 JawMarks::place_of(int landmark, const FaceYaw& yaw) const {
  const glm::dvec3 g = generic_landmark(landmark);
  const glm::dvec2 usual = yaw.seen(g);
  const double wider = g.x * (g.x < 0 ? right : left);
  return {usual.x + wider, usual.y < 0 ? usual.y : usual.y * stretch};
}

}  // namespace fbs
