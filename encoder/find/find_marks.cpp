// Automatic marks.
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "encoder/find/face_yaw.h"
#include "encoder/find/landmarks.h"
#include "encoder/find/marks.h"

namespace fbs {
namespace {

/// The middle of the lids lies this far right of and below the eyes that the cascades give; median over ten
/// faces.
constexpr double kEyeBiasX = 0.04, kEyeBiasY = 0.025;  // eye distances

/// Of the landmarks of both eyes, below their middles: an eye looking at the camera stands wider open than
/// the generic head's, whose lids must close without a fold.
constexpr std::array<double, 12> kLidHeight = {0,     -0.075, -0.075, 0.022, 0.064, 0.064,
                                               0.022, -0.075, -0.075, 0,     0.064, 0.064};

constexpr double kBrowHalfWidth = 0.056;  // eye distances

// Proportions that hold from person to person, measured on neutral pictures of nine people (mean; standard
// deviation): they tie what is hard to see to what is not.
constexpr double kNoseBasePerMouthLine = 0.68;        // of its height below the eyes; 0.02
constexpr double kNostrilsPerMouthLine = 0.565;       // where the nostrils are darkest
constexpr double kUpperLip = 0.13, kLowerLip = 0.19;  // thickness of both; 0.024, 0.039
constexpr double kChinBelowMouth = 0.65;              // 0.085
constexpr double kChinPerOpening = 0.9;               // the jaw goes down with the lower lip

struct MouthMarks {
  double line = 1.12;               // y of the line between the lips, or of the opening's middle
  double right = -0.4, left = 0.4;  // x of the corners
  double right_y = 1.12, left_y = 1.12;
  double top = 1.0, bottom = 1.28;               // y of the lips' outer borders on the midline
  double inner_top = 1.11, inner_bottom = 1.13;  // y of the inner borders; apart by what the mouth is open
};

/// Skin, upper lip, opening, lower lip, skin along the midline: the four borders that leave the least
/// variance of brightness and redness between them, near where lips usually are. Sets top, inner_top,
/// inner_bottom, bottom.
void find_lip_borders(const FaceFrame& f, double middle, MouthMarks& m) {
  constexpr double kStep = 1.0 / 64;
  constexpr int kSamples = 51, kLine = 21;  // from 0.33 above the line to 0.47 below it
  constexpr double kLumaNoise = 10, kRedNoise = 2.5;
  constexpr double kVarianceCost = 0.12, kRedder = 2, kOpenCost = 25;  // per eye distance
  struct Sums {
    double y = 0, yy = 0, r = 0, rr = 0;
  };
  std::array<Sums, kSamples + 1> upto{};
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double at = m.line + (static_cast<int>(i) - kLine) * kStep;
    const double y = mean_over(middle, 0.10, [&](double x) { return f.luma(x, at); }) / kLumaNoise;
    const double r = mean_over(middle, 0.10, [&](double x) { return f.red(x, at); }) / kRedNoise;
    upto[i + 1] = {upto[i].y + y, upto[i].yy + y * y, upto[i].r + r, upto[i].rr + r * r};
  }
  const auto spread = [&](int from, int to) {  // squared deviations within [from, to)
    const Sums &a = upto[from], &b = upto[to];
    const double n = to - from, y = b.y - a.y, r = b.r - a.r;
    return b.yy - a.yy - y * y / n + b.rr - a.rr - r * r / n;
  };
  const auto mean_red = [&](int from, int to) { return (upto[to].r - upto[from].r) / (to - from); };
  const auto squared = [](double v) { return v * v; };
  double best = 1e30;
  std::array<int, 4> found{};
  for (int t = 2; t < kLine - 2; ++t) {
    for (int u = t + 3; u <= kLine + 1; ++u) {
      for (int l = std::max(u + 1, kLine); l <= std::min(u + 24, kSamples - 10); ++l) {
        for (int b = l + 5; b <= std::min(l + 22, kSamples - 4); ++b) {
          const double open = (l - u) * kStep;
          double cost = spread(0, t) + spread(t, u) + spread(u, l) + spread(l, b) + spread(b, kSamples);
          cost *= kVarianceCost;
          cost +=
              squared(((u - t) * kStep - kUpperLip) / 0.05) + squared(((b - l) * kStep - kLowerLip) / 0.075);
          cost += kOpenCost * open;
          // Both lips are redder than the skin, and what lies between them is not redder than they are.
          const double lips = std::min(mean_red(t, u), mean_red(l, b));
          cost -= kRedder * std::clamp(lips - 0.5 * (mean_red(0, t) + mean_red(b, kSamples)), -12.0, 4.0);
          cost += kRedder * std::clamp(mean_red(u, l) - lips, 0.0, 12.0);
          if (cost < best) {
            best = cost;
            found = {t, u, l, b};
          }
        }
      }
    }
  }
  const auto y = [&](std::size_t i) { return m.line + (found[i] - kLine - 0.5) * kStep; };
  m.top = y(0);
  m.inner_top = y(1);
  m.inner_bottom = y(2);
  m.bottom = y(3);
  m.line = 0.5 * (m.inner_top + m.inner_bottom);
}

/// @param turn  of the face: the mouth's middle lies aside by its depth
MouthMarks find_mouth(const FaceFrame& f, const FaceYaw& turn) {
  MouthMarks m;
  const double middle = turn.shift + turn.tangent * generic_landmark(62).z;
  const double nose = turn.shift + turn.tangent * generic_landmark(33).z;
  // The line between the lips: dark, and redder just above and below than farther away; and the nose's base
  // is where it belongs to it.
  m.line = search(0.86, 1.45, 1.11, 0.12, [&](double y) {
    const double dark = mean_over(middle, 0.22, [&](double x) { return f.valley(x, y, 0.09); });
    const double red = mean_over(middle, 0.2, [&](double x) {
      return 0.5 * (f.red(x, y - 0.06) + f.red(x, y + 0.08)) -
             0.5 * (f.red(x, y - 0.26) + f.red(x, y + 0.34));
    });
    const double base =
        mean_over(nose, 0.18, [&](double x) { return f.valley(x, kNostrilsPerMouthLine * y, 0.08); });
    return dark / 8 + red / 5 + base / 8;
  });
  const double seen_line = m.line;
  find_lip_borders(f, middle, m);
  // Each corner: where the line, followed outwards, stops being a valley.
  for (const int side : {-1, 1}) {
    double y = seen_line, reached = 0.26;
    const double start = std::max(
        4.0, mean_over(middle + side * 0.15, 0.1, [&](double x) { return f.valley(x, seen_line, 0.07); }));
    for (double x = 0.1; x <= 0.56; x += 1.0 / 64) {
      const double px = middle + side * x;
      y = search(y - 0.02, y + 0.02, y, 0.02, [&](double v) { return f.valley(px, v, 0.06) / 4; });
      y = std::clamp(y, seen_line - 0.10, seen_line + 0.10);
      if (f.valley(px, y, 0.06) < 0.30 * start && x > 0.28) break;
      reached = x;
    }
    const double corner = middle + side * std::clamp(0.5 * reached + 0.5 * 0.39, 0.30, 0.52);
    (side < 0 ? m.right : m.left) = corner;
    (side < 0 ? m.right_y : m.left_y) = std::clamp(y, m.line - 0.06, m.line + 0.08);
  }
  return m;
}

/// y of the brow's dark ridge above each of five places, outer to inner or inner to outer as x says, smoothed
/// by a parabola.
std::array<double, 5> find_brow(const FaceFrame& f, const std::array<double, 5>& xs,
                                const std::array<double, 5>& usual) {
  // First the brow as a whole, then each place.
  const double lift = search(-0.16, 0.14, 0, 0.06, [&](double d) {
    double sum = 0;
    for (std::size_t i = 0; i < 5; ++i) sum += std::min(12.0, f.valley(xs[i], usual[i] + d, 0.09));
    return sum / 5 / 6;  // a hat's rim is darker than any brow, and no better for it
  });
  cv::Matx33d a = cv::Matx33d::zeros();
  cv::Vec3d b(0, 0, 0);
  std::array<double, 5> ys{};
  for (std::size_t i = 0; i < 5; ++i) {
    const double centre = usual[i] + lift;
    ys[i] = search(centre - 0.07, centre + 0.07, centre, 0.05,
                   [&](double y) { return f.valley(xs[i], y, 0.08) / 8; });
    const double t = static_cast<double>(i) / 4 - 0.5;
    const cv::Vec3d row(1, t, t * t);
    a += row * row.t();
    b += row * ys[i];
  }
  a(2, 2) += 0.05;  // curvature as the generic brow has it unless the picture insists
  double usual_bend = 0.5 * (usual[0] + usual[4]) - usual[2];
  b[2] += 0.05 * usual_bend * 4;
  const cv::Vec3d c = a.inv() * b;
  for (std::size_t i = 0; i < 5; ++i) {
    const double t = static_cast<double>(i) / 4 - 0.5;
    ys[i] = c[0] + c[1] * t + c[2] * t * t;
  }
  return ys;
}

/// How much farther out or in than `usual` the face's border lies at height y: where brightness and colour
/// leave those of the cheek.
double find_side(const FaceFrame& f, int side, double y, double usual) {
  const double cheek = side * (side * usual - 0.5);
  const double skin = f.luma(cheek, 0.55), skin_red = f.red(cheek, 0.55);
  return search(-0.16, 0.16, 0, 0.07, [&](double d) {
    const double x = usual + side * d;
    const double step_y = std::abs(f.luma(x - 0.06, y) - f.luma(x + 0.06, y));
    const double step_red = std::abs(f.red(x - 0.08, y) - f.red(x + 0.08, y));
    const double inside = std::abs(f.luma(x - side * 0.10, y) - skin) / 40 +
                          std::abs(f.red(x - side * 0.10, y) - skin_red) / 10;
    return std::min(2.0, step_y / 20 + step_red / 8) - 0.5 * std::min(2.0, inside);
  });
}

double find_chin(const FaceFrame& f, const MouthMarks& mouth, double middle) {
  const double open = mouth.inner_bottom - mouth.inner_top;
  const double usual = mouth.inner_top + kChinBelowMouth + kChinPerOpening * open;
  return search(usual - 0.16, usual + 0.16, usual, 0.07, [&](double y) {
    const double edge =
        mean_over(middle, 0.2, [&](double x) { return std::abs(f.luma(x, y - 0.05) - f.luma(x, y + 0.05)); });
    return std::min(2.0, edge / 14);
  });
}

/// Maps the generic lips onto the found line, corners and borders.
glm::dvec2 place_lip(const MouthMarks& m, int ibug) {
  const glm::dvec3 g = generic_landmark(ibug);
  const double half = 0.5 * (generic_landmark(54).x - generic_landmark(48).x);
  const double t = 0.5 * (g.x / half + 1);  // 0 at the right corner, 1 at the left
  const double x = m.right + (m.left - m.right) * t;
  const double corners_y = m.right_y + (m.left_y - m.right_y) * t;
  // The line passes through the corners and through the middle of the mouth.
  const double bow = 4 * t * (1 - t);
  const double line = corners_y + (m.line - 0.5 * (m.right_y + m.left_y)) * bow;
  const double upper = generic_landmark(62).y, lower = generic_landmark(66).y;
  const double generic_line = 0.5 * (upper + lower), corner_y = generic_landmark(48).y;
  const double off = g.y - (corner_y + (generic_line - corner_y) * bow);
  // Outside the inner borders as thick as the lips are, inside as far apart as they are.
  const double edge = off < 0 ? generic_line - upper : lower - generic_line;
  const double seen_edge = off < 0 ? m.line - m.inner_top : m.inner_bottom - m.line;
  const double thick = off < 0 ? upper - generic_landmark(51).y : generic_landmark(57).y - lower;
  const double seen_thick = off < 0 ? m.inner_top - m.top : m.bottom - m.inner_bottom;
  const double inside = std::min(std::abs(off), edge * bow), outside = std::abs(off) - inside;
  const double away = seen_edge / edge * inside + seen_thick / thick * outside;
  return {x, line + (off < 0 ? -away : away)};
}

}  // namespace

Marks find_marks(const Picture& picture, const FoundFace& face) {
  const glm::dvec2 across = face.left_eye - face.right_eye;
  const glm::dvec2 down(-across.y, across.x);
  const glm::dvec2 bias = face.eyes_seen ? kEyeBiasX * across + kEyeBiasY * down : glm::dvec2(0);
  const FaceFrame f(picture, face.right_eye + bias, face.left_eye + bias);
  const FaceYaw turn = estimate_yaw(f);
  // Where a landmark of the generic head is seen, turned.
  const auto usual = [&](int ibug) {
    const glm::dvec3 g = generic_landmark(ibug);
    return glm::dvec2(turn.shift + g.x + turn.tangent * g.z, g.y);
  };

  Marks marks;
  const auto set = [&](int ibug, glm::dvec2 p) { marks.set_landmark(ibug, f.to_picture(p)); };
  for (int k = 36; k < 48; ++k) set(k, {usual(k).x, kLidHeight[k - 36]});

  const MouthMarks mouth = find_mouth(f, turn);
  for (int k = 48; k < 68; ++k) set(k, place_lip(mouth, k));

  for (const int first : {17, 22}) {
    std::array<double, 5> xs{}, ridge{};
    for (int i = 0; i < 5; ++i) {
      xs[i] = usual(first + i).x;
      ridge[i] = usual(first + i).y + kBrowHalfWidth;
    }
    const auto ys = find_brow(f, xs, ridge);
    // What is found is the brow's middle; its landmarks lie on the upper border.
    for (int i = 0; i < 5; ++i) set(first + i, {xs[i], ys[i] - kBrowHalfWidth});
  }

  // The nose's base goes with the upper lip; nostrils and the shadow under the tip are dark.
  const double generic_base = generic_landmark(33).y, middle = usual(33).x;
  const double closed_line = mouth.inner_top + 0.01;
  const double base = search(
      generic_base - 0.2, generic_base + 0.2, kNoseBasePerMouthLine * closed_line, 0.04, [&](double y) {
        const double nostrils = y * kNostrilsPerMouthLine / kNoseBasePerMouthLine;
        return mean_over(middle, 0.18, [&](double x) { return f.valley(x, nostrils, 0.08); }) / 8;
      });
  for (int k = 27; k < 36; ++k) set(k, {usual(k).x, k == 27 ? usual(k).y : usual(k).y * base / generic_base});

  const double chin = find_chin(f, mouth, usual(8).x);
  const double jaw_stretch = chin / generic_landmark(8).y;
  double right = 0, left = 0;  // how much farther out the sides lie, as a share
  for (const int k : {1, 2, 3, 4}) {
    const double y = usual(k).y * jaw_stretch, wide = generic_landmark(16 - k).x;
    right += find_side(f, -1, y, usual(k).x) / wide / 4;
    left += find_side(f, 1, y, usual(16 - k).x) / wide / 4;
  }
  for (int k = 0; k < 17; ++k) {
    const double x = generic_landmark(k).x, wider = x * (x < 0 ? right : left);
    set(k, {usual(k).x + wider, usual(k).y < 0 ? usual(k).y : usual(k).y * jaw_stretch});
  }
  return marks;
}

}  // namespace fbs
