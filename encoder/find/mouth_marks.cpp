#include "encoder/find/mouth_marks.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/evidence.h"
#include "encoder/find/landmarks.h"

namespace fbs {

using namespace find_tuning;

namespace {

/// The line between the lips: dark, and redder just above and below than farther away; and the nose's base is
/// where it belongs to it.
double find_line(const FaceFrame& f, double middle, double nose) {
  return search(kMouthLineFrom, kMouthLineTo, kMouthLine, kMouthLineSigma, [&](double y) {
    const double dark = mean_over(middle, kLineHalf, [&](double x) { return f.valley(x, y, kLineReach); });
    const double red = mean_over(middle, kLipsHalf, [&](double x) {
      return 0.5 * (f.red(x, y - kRedAbove) + f.red(x, y + kRedBelow)) -
             0.5 * (f.red(x, y - kSkinAbove) + f.red(x, y + kSkinBelow));
    });
    const double base = mean_over(
        nose, kNostrilHalf, [&](double x) { return f.valley(x, kNostrilsPerMouthLine * y, kNostrilReach); });
    return dark / kValleyPerEvidence + red / kRednessPerEvidence + base / kValleyPerEvidence;
  });
}

/// Where the line, followed outwards, stops being a valley.
/// @param line  the mouth's own, which may lie elsewhere than the dark line when it is open
glm::dvec2 find_corner(const FaceFrame& f, double middle, int side, double dark_line, double line) {
  double y = dark_line, reached = kCornerStart;
  const double start =
      std::max(kMinStartValley, mean_over(middle + side * kStartMiddle, kStartHalf,
                                          [&](double x) { return f.valley(x, dark_line, kStartReach); }));
  for (double x = kCornerFrom; x <= kCornerTo; x += kCornerStep) {
    const double px = middle + side * x;
    y = search(y - kFollowReach, y + kFollowReach, y, kFollowReach,
               [&](double v) { return f.valley(px, v, kCornerReach) / kCornerValleyPerEvidence; });
    y = std::clamp(y, dark_line - kFollowMax, dark_line + kFollowMax);
    if (f.valley(px, y, kCornerReach) < kCornerEnds * start && x > kCornerMayEnd) break;
    reached = x;
  }
  const double away = kCornerShare * reached + kCornerShare * kUsualCorner;
  return {middle + side * std::clamp(away, kMinCorner, kMaxCorner),
          std::clamp(y, line - kCornerAbove, line + kCornerBelow)};
}

}  // namespace

MouthMarks find_mouth(const FaceFrame& f, const FaceYaw& yaw) {
  const double middle = yaw.midline(generic_landmark(ibug::kUpperLipInner).z);
  const double nose = yaw.midline(generic_landmark(ibug::kNoseBase).z);
  const double dark_line = find_line(f, middle, nose);
  MouthMarks m;
  m.lips = find_lip_borders(f, middle, dark_line);
  m.line = 0.5 * (m.lips.inner_top + m.lips.inner_bottom);
  m.right = find_corner(f, middle, -1, dark_line, m.line);
  m.left = find_corner(f, middle, 1, dark_line, m.line);
  return m;
}

glm::dvec2 MouthMarks::place_of(int landmark) const {
  const glm::dvec3 g = generic_landmark(landmark);
  const double half = 0.5 * (generic_landmark(ibug::kMouthLeft).x - generic_landmark(ibug::kMouthRight).x);
  const double t = 0.5 * (g.x / half + 1);  // 0 at the right corner, 1 at the left
  const double x = right.x + (left.x - right.x) * t;
  const double corners_y = right.y + (left.y - right.y) * t;
  // The line passes through the corners and through the middle of the mouth.
  const double bow = 4 * t * (1 - t);
  const double line_y = corners_y + (line - 0.5 * (right.y + left.y)) * bow;
  const double upper = generic_landmark(ibug::kUpperLipInner).y,
               lower = generic_landmark(ibug::kLowerLipInner).y;
  const double generic_line = 0.5 * (upper + lower), corner_y = generic_landmark(ibug::kMouthRight).y;
  const double off = g.y - (corner_y + (generic_line - corner_y) * bow);
  // Outside the inner borders as thick as the lips are, inside as far apart as they are.
  const bool above = off < 0;
  const double edge = above ? generic_line - upper : lower - generic_line;
  const double seen_edge = above ? line - lips.inner_top : lips.inner_bottom - line;
  const double thick = above ? upper - generic_landmark(ibug::kUpperLipTop).y
                             : generic_landmark(ibug::kLowerLipBottom).y - lower;
  const double seen_thick = above ? lips.inner_top - lips.top : lips.bottom - lips.inner_bottom;
  const double inside = std::min(std::abs(off), edge * bow), outside = std::abs(off) - inside;
  const double away = seen_edge / edge * inside + seen_thick / thick * outside;
  return {x, line_y + (above ? -away : away)};
}

}  // namespace fbs
