#include "encoder/track/feature_snake.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <opencv2/imgproc.hpp>

namespace fbs {
namespace {

constexpr double kPxPerUnit = 1.5;  // patch resolution: WorkFrame's 48 pixels per eye distance

/// How a kind of feature is followed. Lengths in snake units.
struct Kind {
  SnakeWeights weights;
  int points;                  // p + 1 of the curve
  double blur;                 // of the feature map
  double above, below, aside;  // of the patch beyond the feature at rest
};

// Found by looking at where the contours settle on the clips and on the talker; the contrast sets the scale.
constexpr Kind kOuterLips = {{.tension = 0.0012,
                              .rigidity = 0.002,
                              .temporal = 0.004,
                              .shape = 0.012,
                              .repulsion = 0.10,
                              .contrast = 1,
                              .change = 0.05},
                             40,
                             1.2,
                             9,
                             16,
                             9};
constexpr Kind kInnerLips = {{.tension = 0.0008,
                              .rigidity = 0.002,
                              .temporal = 0.004,
                              .shape = 0.02,
                              .repulsion = 0.30,
                              .contrast = 1,
                              .change = 0},
                             32,
                             0.9,
                             8,
                             16,
                             6};
constexpr Kind kBrow = {{.tension = 2e-5,
                         .rigidity = 4e-5,
                         .temporal = 0.02,
                         .shape = 4e-4,
                         .repulsion = 0.05,
                         .contrast = 1,
                         .change = 0},
                        13,
                        1.2,
                        10,
                        7,
                        6};
constexpr Kind kUpperLid = {{.tension = 2e-4,
                             .rigidity = 2e-4,
                             .temporal = 0.004,
                             .shape = 8e-4,
                             .repulsion = 0,
                             .contrast = 1,
                             .change = 0.05},
                            11,
                            0.8,
                            6,
                            8,
                            4};

constexpr double kLipLeastGap = 0.8, kMouthLeastWidth = 0.7, kBrowLeastLength = 0.97;  // of the gap at rest
constexpr double kLidsApart = 0.45;      // shut eyes keep a line of lashes
constexpr double kThickLips = 11;        // both lips together: an open mouth may close
constexpr double kBrowBelowMarks = 1.8;  // iBUG marks a brow's upper border; its middle lies this far below

const Kind& kind_of(FeatureId id) {
  switch (id) {
    case FeatureId::kMouthOuter:
      return kOuterLips;
    case FeatureId::kMouthInner:
      return kInnerLips;
    case FeatureId::kBrowRight:
    case FeatureId::kBrowLeft:
      return kBrow;
    default:
      return kUpperLid;
  }
}

bool is_brow(FeatureId id) {
  return id == FeatureId::kBrowRight || id == FeatureId::kBrowLeft;
}

SnakeCurve curve_of(FeatureId id) {
  const Feature& f = feature(id);
  const int points = kind_of(id).points;
  return f.closed ? SnakeCurve::closed(f.control_count, points) : SnakeCurve::clamped(points, is_brow(id));
}

/// Landmarks between which an upper lid is spanned, in order of s.
std::array<int, 2> corners_of(FeatureId id) {
  return id == FeatureId::kUpperLidLeft ? std::array<int, 2>{42, 45} : std::array<int, 2>{36, 39};
}

glm::dvec2 on_head(const Geometry& geometry, std::size_t vertex) {
  const glm::dvec3 p(geometry.positions[vertex]);
  return glm::dvec2(p.x, p.y) / kHeadUnitsPerSnakeUnit;
}

std::vector<cv::Point> polygon(const FeatureSnake& s) {
  std::vector<cv::Point> out;
  for (const SplineBasis& b : s.curve.points()) {
    const glm::dvec2 p = (curve_point(b, s.rest) - glm::dvec2(s.region.x, s.region.y)) * kPxPerUnit;
    out.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
  }
  return out;
}

void add_pair(FeatureSnake& s, int from, int to, glm::dvec2 direction, double share) {
  const glm::dvec2 gap =
      curve_point(s.curve.points()[to], s.rest) - curve_point(s.curve.points()[from], s.rest);
  s.facing.push_back({from, to, direction, share * (gap.x * direction.x + gap.y * direction.y)});
}

/// Upper points of a closed mouth curve lie at s in (0, n / 2), the lower that faces each at n - s.
void add_facing_lips(FeatureSnake& s, bool inner) {
  const int points = static_cast<int>(s.curve.points().size());
  for (int h = 3; h <= points / 2 - 3; ++h) {
    add_pair(s, h, points - h, {0, 1}, kLipLeastGap);
    // Inner lips may touch, but not pass each other.
    s.facing.back().least_gap = inner ? 0.0 : std::min(s.facing.back().least_gap, kLipLeastGap * kThickLips);
  }
  add_pair(s, 0, points / 2, {1, 0}, kMouthLeastWidth);
}

cv::Mat disc(double radius) {
  const int r = std::max(1, static_cast<int>(std::lround(radius * kPxPerUnit)));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * r + 1, 2 * r + 1});
}

/// Rows that a patch comes from, with the neighbours that interpolation asks for; one at least.
cv::Range rows_of(const cv::Matx23d& m, cv::Size patch, int rows) {
  constexpr double kMargin = 2;
  const double across = m(1, 0) * patch.width, down = m(1, 1) * patch.height;
  const double first = m(1, 2) + std::min(across, 0.0) + std::min(down, 0.0) - kMargin;
  const double last = m(1, 2) + std::max(across, 0.0) + std::max(down, 0.0) + kMargin;
  const int start = static_cast<int>(std::clamp(first, 0.0, rows - 1.0));
  return {start, std::max(start + 1, static_cast<int>(std::clamp(last + 1, 0.0, 1.0 * rows)))};
}

/// A Gaussian as a column, snake units. Kept: OpenCV takes longer to work one out than to blur with it.
const cv::Mat& gaussian(double sigma_units) {
  static std::map<double, cv::Mat> kept;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  cv::Mat& kernel = kept[sigma_units];
  if (kernel.empty()) {
    const double sigma = sigma_units * kPxPerUnit;
    kernel = cv::getGaussianKernel(2 * static_cast<int>(std::lround(3 * sigma)) + 1, sigma, CV_32F);
  }
  return kernel;
}

void blur(const cv::Mat1f& in, cv::Mat1f& out, const cv::Mat& kernel) {
  cv::sepFilter2D(in, out, CV_32F, kernel, kernel);
}

/// Central differences per snake unit, times `sign`; none across the border.
void slopes(const cv::Mat1f& values, float sign, cv::Mat1f& by_x, cv::Mat1f& by_y) {
  const float half = sign * static_cast<float>(0.5 * kPxPerUnit);
  const int w = values.cols, h = values.rows;
  by_x.create(values.size());
  by_y.create(values.size());
  for (int y = 0; y < h; ++y) {
    // The border is mirrored, as OpenCV's filters do: what meets there is alike.
    const float *above = values[y > 0 ? y - 1 : 1], *here = values[y],
                *below = values[y < h - 1 ? y + 1 : h - 2];
    float *dx = by_x[y], *dy = by_y[y];
    for (int x = 1; x < w - 1; ++x) dx[x] = half * (here[x + 1] - here[x - 1]);
    dx[0] = dx[w - 1] = 0;
    for (int x = 0; x < w; ++x) dy[x] = half * (below[x] - above[x]);
  }
}

}  // namespace

SplineBasis basis_at(const SnakeCurve& curve, double s) {
  return curve.is_closed() ? closed_basis(curve.controls(), s) : clamped_basis(true, s);
}

std::vector<glm::dvec2> fit_control(const Feature& f, const SnakeCurve& curve,
                                    const std::vector<glm::dvec2>& target,
                                    const std::array<glm::dvec2, 2>& ends) {
  const int n = curve.controls();
  cv::Mat1d a = cv::Mat1d::zeros(n, n), b = cv::Mat1d::zeros(n, 2);
  const auto add = [&](const SplineBasis& basis, const std::array<double, 4>& weight, double w,
                       glm::dvec2 value) {
    for (std::size_t i = 0; i < 4; ++i) {
      b(basis.control[i], 0) += w * weight[i] * value.x;
      b(basis.control[i], 1) += w * weight[i] * value.y;
      for (std::size_t j = 0; j < 4; ++j) a(basis.control[i], basis.control[j]) += w * weight[i] * weight[j];
    }
  };
  for (std::size_t k = 0; k < f.vertices.size(); ++k) {
    const SplineBasis basis = basis_at(curve, static_cast<double>(f.vertices[k].s));
    add(basis, basis.value, 1, target[k]);
  }
  for (const SplineBasis& basis : curve.points()) add(basis, basis.d2, 1e-4, {0, 0});
  if (curve.first_free() > 0) {
    constexpr double kPinned = 1e6;
    for (int end = 0; end < 2; ++end) {
      const int i = end == 0 ? 0 : n - 1;
      a(i, i) += kPinned;
      b(i, 0) += kPinned * ends[end].x;
      b(i, 1) += kPinned * ends[end].y;
    }
  }
  cv::Mat1d x;
  cv::solve(a, b, x, cv::DECOMP_CHOLESKY);
  std::vector<glm::dvec2> control;
  for (int i = 0; i < n; ++i) control.emplace_back(x(i, 0), x(i, 1));
  return control;
}

FeatureSnake FeatureSnake::make(FeatureId id, const Geometry& geometry) {
  const Feature& f = feature(id);
  const Kind& kind = kind_of(id);
  FeatureSnake s{.id = id, .curve = curve_of(id), .weights = kind.weights};
  s.below_vertices = is_brow(id) ? kBrowBelowMarks : 0;
  std::vector<glm::dvec2> target;
  for (const FeatureVertex& v : f.vertices) {
    const auto vertex = v.vertex;
    target.push_back(on_head(geometry, vertex) + glm::dvec2(0, s.below_vertices));
    s.depth += geometry.positions[vertex].z / static_cast<double>(f.vertices.size());
  }
  const auto corner = corners_of(id);
  std::array<glm::dvec2, 2> ends{};
  for (std::size_t k = 0; k < 2; ++k)
    ends[k] = on_head(geometry, static_cast<std::size_t>(vertex_of_landmark(corner[k])));
  s.rest = s.now = fit_control(f, s.curve, target, ends);

  std::vector<glm::dvec2> extent = target;
  if (s.curve.first_free() > 0) extent.insert(extent.end(), ends.begin(), ends.end());
  const auto [x0, x1] =
      std::minmax_element(extent.begin(), extent.end(), [](auto a, auto b) { return a.x < b.x; });
  const auto [y0, y1] =
      std::minmax_element(extent.begin(), extent.end(), [](auto a, auto b) { return a.y < b.y; });
  s.region = {x0->x - kind.aside, y0->y - kind.above, x1->x - x0->x + 2 * kind.aside,
              y1->y - y0->y + kind.above + kind.below};
  if (f.closed) add_facing_lips(s, id == FeatureId::kMouthInner);
  if (s.curve.first_free() > 0) {
    const int lower = id == FeatureId::kUpperLidLeft ? 46 : 40;
    s.lowest = -kLidsApart;
    for (const int k : {lower, lower + 1}) s.lowest += on_head(geometry, vertex_of_landmark(k)).y / 2;
  }
  if (is_brow(id)) add_pair(s, 0, kind.points - 1, {1, 0}, kBrowLeastLength);
  return s;
}

void FeatureSnake::limit(std::vector<glm::dvec2>& control) const {
  // The middle of a clamped cubic moves by 3/4 of what both inner control points do.
  const double beyond = curve_point(clamped_basis(true, 0.5), control).y - lowest;
  if (beyond <= 0) return;
  for (int i = curve.first_free(); i < curve.end_free(); ++i) control[i].y -= beyond / 0.75;
}

FeaturePatch FeatureSnake::patch(const WorkFrame& frame, const Pose& pose) const {
  const PoseProjection projection(pose);
  const auto work = [&](glm::dvec2 snake) {
    return frame.to_work(projection(glm::dvec3(snake * kHeadUnitsPerSnakeUnit, depth)));
  };
  const glm::dvec2 corner(region.x, region.y);
  const glm::dvec2 o = work(corner), ex = work(corner + glm::dvec2(1 / kPxPerUnit, 0)) - o,
                   ey = work(corner + glm::dvec2(0, 1 / kPxPerUnit)) - o;
  const cv::Matx23d m(ex.x, ey.x, o.x, ex.y, ey.y, o.y);
  const cv::Size size(static_cast<int>(region.width * kPxPerUnit),
                      static_cast<int>(region.height * kPxPerUnit));
  FeaturePatch out;
  const auto cut = [&](const cv::Mat& source, const cv::Matx23d& to_source, cv::Mat& patch) {
    cv::warpAffine(source, patch, to_source, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
  };
  if (is_brow(id)) {  // hair differs from skin in brightness
    cut(frame.luma, m, out[0]);
    return out;
  }
  // All planes at once: most of the work is finding the place. Only the rows that the patch shows are put
  // together.
  const cv::Range rows = rows_of(m, size, frame.luma.rows);
  cv::Mat together, patch;
  cv::merge(std::array{frame.luma.rowRange(rows), frame.u.rowRange(rows), frame.v.rowRange(rows)}, together);
  cut(together, {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2) - rows.start}, patch);
  cv::split(patch, out);
  return out;
}

void FeatureSnake::learn(const FeaturePatch& first) {
  const auto outline = polygon(*this);
  cv::Mat inside = cv::Mat::zeros(first[0].size(), CV_8UC1), around, grown;
  const std::vector<std::vector<cv::Point>> shape{outline};
  switch (id) {
    case FeatureId::kMouthOuter:
      cv::fillPoly(inside, shape, 255);
      cv::dilate(inside, around, disc(4));
      cv::dilate(inside, grown, disc(1));
      break;
    case FeatureId::kMouthInner: {
      // The lips themselves: a band round the line between them.
      cv::Mat gap = inside.clone();
      cv::fillPoly(gap, shape, 255);
      cv::dilate(gap, inside, disc(2));
      cv::dilate(gap, gap, disc(0.7));
      map = FeatureMap::likeness(first, inside - gap);
      return;
    }
    case FeatureId::kBrowRight:
    case FeatureId::kBrowLeft:
      cv::polylines(inside, outline, false, 255, static_cast<int>(std::lround(2 * kPxPerUnit)));
      cv::dilate(inside, around, disc(4.5));
      cv::dilate(inside, grown, disc(2));
      break;
    default: {
      // Lashes and eye below the lid's edge, the lid's skin above it.
      const auto shifted = [&](double units) {
        std::vector<cv::Point> out = outline;
        for (cv::Point& p : out) p.y += static_cast<int>(std::lround(units * kPxPerUnit));
        return out;
      };
      const int thick = static_cast<int>(std::lround(1.4 * kPxPerUnit));
      around = inside.clone();
      cv::polylines(inside, shifted(1), false, 255, thick);
      cv::polylines(around, shifted(-2), false, 255, thick);
      // Dark lashes are below the edge, but below the lower lid's lashes too; skin of the lid is above this
      // one only.
      skin = FeatureMap::likeness(first, around);
      grown = cv::Mat::zeros(inside.size(), CV_8UC1);
      break;
    }
  }
  map = FeatureMap::discriminant(first, inside, around - grown, id != FeatureId::kMouthOuter);
}

SnakeImage FeatureSnake::look(const FeaturePatch& patch) {
  const Kind& kind = kind_of(id);
  cv::Mat1f values = map(patch);
  if (skin) cv::addWeighted(values, 0.5, (*skin)(patch), -0.5, 0, values);
  blur(values, values, gaussian(kind.blur));
  SnakeImage image;
  image.origin = {region.x, region.y};
  image.px_per_unit = kPxPerUnit;
  if (is_brow(id)) {
    // Centre less surround: largest along the middle of a band as wide as a brow.
    constexpr double kSurround = 3;
    blur(values, image.ridge, gaussian(kSurround));
    cv::subtract(values, image.ridge, image.ridge);
  } else {
    // Outer contours have the feature inside them, inner lips outside.
    slopes(values, id == FeatureId::kMouthInner ? -1 : 1, image.contrast_x, image.contrast_y);
  }
  if (weights.change != 0) {
    if (seen.empty())
      image.change = cv::Mat1f::zeros(values.size());
    else
      cv::absdiff(values, seen, image.change);
    seen = values;
  }
  return image;
}

}  // namespace fbs
