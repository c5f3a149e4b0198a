// Automatic marks. The face is first brought into a frame of its own: eyes level, kRes pixels apart.
#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "encoder/marks.h"
#include "encoder/planes.h"

namespace fbs {
namespace {

constexpr double kRes = 64;  // pixels per eye distance in the face's own frame
constexpr double kLeft = -1.6, kTop = -1.4, kWidth = 3.2, kHeight = 4.0;  // of that frame, eye distances

/// The middle of the lids lies this far right of and below the eyes that the cascades give; median over ten
/// faces.
constexpr double kEyeBiasX = 0.04, kEyeBiasY = 0.025;  // eye distances

constexpr double kBrowHalfWidth = 0.056;  // eye distances

/// The face, eyes level at (-0.5, 0) and (0.5, 0) in eye distances, y down.
struct OwnFrame {
  cv::Mat luma, cr;           // float
  glm::dvec2 origin, x_axis;  // pixels per eye distance in the picture

  OwnFrame(const Picture& picture, glm::dvec2 right, glm::dvec2 left)
      : origin(0.5 * (right + left)), x_axis(left - right) {
    luma = warp(picture.y, 1.0);
    cr = warp(picture.v, 0.5);
    const double blur = std::max(0.6, 0.02 * kRes);
    cv::GaussianBlur(luma, luma, {}, blur);
    cv::GaussianBlur(cr, cr, {}, 2 * blur);
  }

  [[nodiscard]] glm::dvec2 to_picture(glm::dvec2 p) const {
    return origin + p.x * x_axis + p.y * glm::dvec2(-x_axis.y, x_axis.x);
  }

  /// Bilinear, at p in eye distances.
  static double at(const cv::Mat& m, double x, double y) {
    const double u = std::clamp((x - kLeft) * kRes, 0.0, m.cols - 1.001);
    const double v = std::clamp((y - kTop) * kRes, 0.0, m.rows - 1.001);
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const double fu = u - i, fv = v - j;
    const float *a = m.ptr<float>(j) + i, *b = m.ptr<float>(j + 1) + i;
    return (a[0] * (1 - fu) + a[1] * fu) * (1 - fv) + (b[0] * (1 - fu) + b[1] * fu) * fv;
  }
  [[nodiscard]] double y(double px, double py) const { return at(luma, px, py); }
  [[nodiscard]] double red(double px, double py) const { return at(cr, px, py); }

 private:
  [[nodiscard]] cv::Mat warp(const Plane& plane, double plane_scale) const {
    // From own-frame pixel (i, j) to plane sample; pixel centres at + 0.5.
    const glm::dvec2 ex = x_axis * plane_scale / kRes, ey(-ex.y, ex.x);
    const glm::dvec2 o = to_picture({kLeft, kTop}) * plane_scale - 0.5;
    const cv::Matx23d m(ex.x, ey.x, o.x, ex.y, ey.y, o.y);
    const cv::Size size(static_cast<int>(kWidth * kRes), static_cast<int>(kHeight * kRes));
    cv::Mat source = view(plane), out;
    const double shrink = std::hypot(ex.x, ex.y);
    if (shrink > 1.5) cv::GaussianBlur(source, source, {}, 0.4 * shrink);
    cv::warpAffine(source, out, m, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    out.convertTo(out, CV_32F);
    return out;
  }
};

/// The place in [from, to] where `evidence` less a penalty for distance from `usual` is largest.
/// @param spread  distance from the usual place that costs as much as `evidence` of one
double search(double from, double to, double usual, double spread,
              const std::function<double(double)>& evidence) {
  constexpr double kStep = 1.0 / 128;
  double best = usual, best_score = -1e30;
  for (double p = from; p <= to; p += kStep) {
    const double d = (p - usual) / spread;
    const double score = evidence(p) - d * d;
    if (score > best_score) {
      best_score = score;
      best = p;
    }
  }
  return best;
}

/// How much darker than above and below (by `reach`) it is at (x, y), in grey levels.
double valley(const OwnFrame& f, double x, double y, double reach) {
  return 0.5 * (f.y(x, y - reach) + f.y(x, y + reach)) - f.y(x, y);
}

/// Mean over x in [-half, half] about cx.
double mean_over(double cx, double half, const std::function<double(double)>& value) {
  double sum = 0;
  constexpr int kSamples = 13;
  for (int i = 0; i < kSamples; ++i) sum += value(cx + half * (2.0 * i / (kSamples - 1) - 1));
  return sum / kSamples;
}

struct MouthMarks {
  double line = 1.12;               // y of the line between the lips
  double right = -0.4, left = 0.4;  // x of the corners
  double right_y = 1.12, left_y = 1.12;
  double top = 1.0, bottom = 1.28;  // y of the lips' outer borders on the midline
};

MouthMarks find_mouth(const OwnFrame& f) {
  MouthMarks m;
  // The line between the lips: dark, and redder just above and below than farther away.
  m.line = search(0.88, 1.4, 1.10, 0.10, [&](double y) {
    const double dark = mean_over(0, 0.22, [&](double x) { return valley(f, x, y, 0.09); });
    const double red = mean_over(0, 0.2, [&](double x) {
      return 0.5 * (f.red(x, y - 0.06) + f.red(x, y + 0.08)) -
             0.5 * (f.red(x, y - 0.26) + f.red(x, y + 0.34));
    });
    return dark / 8 + red / 5;
  });
  // Each corner: where the line, followed outwards, stops being a valley.
  for (const int side : {-1, 1}) {
    double y = m.line, reached = 0.26;
    const double start =
        std::max(4.0, mean_over(side * 0.15, 0.1, [&](double x) { return valley(f, x, m.line, 0.07); }));
    for (double x = 0.1; x <= 0.56; x += 1.0 / 64) {
      y = search(y - 0.02, y + 0.02, y, 0.02, [&](double v) { return valley(f, side * x, v, 0.06) / 4; });
      y = std::clamp(y, m.line - 0.10, m.line + 0.10);
      if (valley(f, side * x, y, 0.06) < 0.30 * start && x > 0.28) break;
      reached = x;
    }
    const double corner = std::clamp(0.5 * reached + 0.5 * 0.40, 0.30, 0.52);
    (side < 0 ? m.right : m.left) = side * corner;
    (side < 0 ? m.right_y : m.left_y) = std::clamp(y, m.line - 0.06, m.line + 0.08);
  }
  // Lip borders: redness falls towards the skin.
  m.top = search(m.line - 0.22, m.line - 0.06, m.line - 0.12, 0.05, [&](double y) {
    const double red = mean_over(0, 0.12, [&](double x) { return f.red(x, y + 0.04) - f.red(x, y - 0.04); });
    const double dark = mean_over(0, 0.12, [&](double x) { return f.y(x, y - 0.03) - f.y(x, y + 0.03); });
    return red / 3 + dark / 12;
  });
  m.bottom = search(m.line + 0.08, m.line + 0.32, m.line + 0.18, 0.06, [&](double y) {
    const double red = mean_over(0, 0.12, [&](double x) { return f.red(x, y - 0.04) - f.red(x, y + 0.04); });
    const double dark = mean_over(0, 0.12, [&](double x) { return valley(f, x, y + 0.02, 0.06); });
    return red / 3 + dark / 12;
  });
  return m;
}

/// y of the brow's dark ridge above each of five places, outer to inner or inner to outer as x says, smoothed
/// by a parabola.
std::array<double, 5> find_brow(const OwnFrame& f, const std::array<double, 5>& xs,
                                const std::array<double, 5>& usual) {
  // First the brow as a whole, then each place.
  const double lift = search(-0.16, 0.14, 0, 0.09, [&](double d) {
    double sum = 0;
    for (std::size_t i = 0; i < 5; ++i) sum += valley(f, xs[i], usual[i] + d, 0.09);
    return sum / 5 / 6;
  });
  cv::Matx33d a = cv::Matx33d::zeros();
  cv::Vec3d b(0, 0, 0);
  std::array<double, 5> ys{};
  for (std::size_t i = 0; i < 5; ++i) {
    const double centre = usual[i] + lift;
    ys[i] = search(centre - 0.07, centre + 0.07, centre, 0.05,
                   [&](double y) { return valley(f, xs[i], y, 0.08) / 8; });
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

/// x of the face's border at height y on one side: where brightness and colour leave those of the cheek.
double find_side(const OwnFrame& f, int side, double y, double usual) {
  const double skin = f.y(side * 0.55, 0.55), skin_red = f.red(side * 0.55, 0.55);
  return side * search(usual - 0.22, usual + 0.22, usual, 0.14, [&](double x) {
           const double step_y = std::abs(f.y(side * (x - 0.06), y) - f.y(side * (x + 0.06), y));
           const double step_red = std::abs(f.red(side * (x - 0.08), y) - f.red(side * (x + 0.08), y));
           const double inside = std::abs(f.y(side * (x - 0.10), y) - skin) / 40 +
                                 std::abs(f.red(side * (x - 0.10), y) - skin_red) / 10;
           return std::min(3.0, step_y / 15 + step_red / 5) - 0.5 * std::min(2.0, inside);
         });
}

double find_chin(const OwnFrame& f, double mouth_line) {
  const double usual = mouth_line + 0.72;
  return search(usual - 0.22, usual + 0.24, usual, 0.12, [&](double y) {
    const double edge =
        mean_over(0, 0.2, [&](double x) { return std::abs(f.y(x, y - 0.05) - f.y(x, y + 0.05)); });
    return std::min(2.5, edge / 12);
  });
}

glm::dvec2 generic_at(int ibug) {
  const glm::ivec3 p =
      generic_head()
          .vertices[static_cast<std::size_t>(generic_head().landmark_vertex[static_cast<std::size_t>(ibug)])]
          .position;
  return glm::dvec2(p.x, p.y) / static_cast<double>(kUnitsPerEyeDistance);
}

/// Maps the generic lips onto the found line, corners and borders.
glm::dvec2 place_lip(const MouthMarks& m, int ibug) {
  const glm::dvec2 g = generic_at(ibug);
  const double half = 0.5 * (generic_at(54).x - generic_at(48).x);
  const double t = 0.5 * (g.x / half + 1);  // 0 at the right corner, 1 at the left
  const double x = m.right + (m.left - m.right) * t;
  const double corners_y = m.right_y + (m.left_y - m.right_y) * t;
  const double bow =
      4 * t * (1 - t);  // the line passes through the corners and through the middle of the mouth
  const double line = corners_y + (m.line - 0.5 * (m.right_y + m.left_y)) * bow;
  const double generic_line = 0.5 * (generic_at(62).y + generic_at(66).y);
  const double corner_line = generic_at(48).y + (generic_line - generic_at(48).y) * bow;
  const double above = (m.line - m.top) / (generic_line - generic_at(51).y);
  const double below = (m.bottom - m.line) / (generic_at(57).y - generic_line);
  const double off = g.y - corner_line;
  return {x, line + off * (off < 0 ? above : below)};
}

}  // namespace

Marks find_marks(const Picture& picture, const FoundFace& face) {
  const glm::dvec2 across = face.left_eye - face.right_eye;
  const glm::dvec2 down(-across.y, across.x);
  const glm::dvec2 bias = face.eyes_seen ? kEyeBiasX * across + kEyeBiasY * down : glm::dvec2(0);
  const OwnFrame f(picture, face.right_eye + bias, face.left_eye + bias);

  Marks marks;
  const auto set = [&](int ibug, glm::dvec2 p) { marks.set_landmark(ibug, f.to_picture(p)); };
  for (int k = 36; k < 48; ++k) set(k, generic_at(k));

  const MouthMarks mouth = find_mouth(f);
  for (int k = 48; k < 68; ++k) set(k, place_lip(mouth, k));

  for (const int first : {17, 22}) {
    std::array<double, 5> xs{}, usual{};
    for (int i = 0; i < 5; ++i) {
      xs[static_cast<std::size_t>(i)] = generic_at(first + i).x;
      usual[static_cast<std::size_t>(i)] = generic_at(first + i).y + kBrowHalfWidth;
    }
    const auto ys = find_brow(f, xs, usual);
    // What is found is the brow's middle; its landmarks lie on the upper border.
    for (int i = 0; i < 5; ++i)
      set(first + i, {xs[static_cast<std::size_t>(i)], ys[static_cast<std::size_t>(i)] - kBrowHalfWidth});
  }

  // The nose's base follows the mouth's height; nostrils and the shadow under the tip are dark.
  const double usual_base = generic_at(33).y * (0.5 + 0.5 * mouth.line / 1.12);
  const double base = search(usual_base - 0.14, usual_base + 0.14, usual_base, 0.07, [&](double y) {
    return mean_over(0, 0.18, [&](double x) { return valley(f, x, y, 0.08); }) / 8;
  });
  const double stretch = base / generic_at(33).y;
  for (int k = 27; k < 36; ++k) set(k, {generic_at(k).x, generic_at(k).y * (k == 27 ? 1 : stretch)});

  const double chin = find_chin(f, mouth.line);
  const double jaw_stretch = chin / generic_at(8).y;
  double width_right = 0, width_left = 0;
  for (const int k : {1, 2, 3, 4}) {
    const double y = generic_at(k).y * jaw_stretch;
    width_right += find_side(f, -1, y, -generic_at(k).x) / generic_at(k).x / 4;
    width_left += find_side(f, 1, y, generic_at(16 - k).x) / generic_at(16 - k).x / 4;
  }
  for (int k = 0; k < 17; ++k) {
    const glm::dvec2 g = generic_at(k);
    const double wide = g.x < 0 ? width_right : width_left;
    set(k, {g.x * std::clamp(wide, 0.8, 1.25), g.y < 0 ? g.y : g.y * jaw_stretch});
  }
  return marks;
}

}  // namespace fbs
