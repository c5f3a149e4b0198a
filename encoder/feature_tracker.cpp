#include "encoder/feature_tracker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fbs {
namespace {

constexpr double kPxPerUnit = 1.5;   // patch resolution: WorkFrame's 48 pixels per eye distance
constexpr double kBlur = 1.2;        // of the feature map, snake units
constexpr int kLipPoints = 40, kBrowPoints = 13;
constexpr double kLipLeastGap = 0.8, kMouthLeastWidth = 0.7, kBrowLeastLength = 0.97;  // of the gap at rest
constexpr double kBrowBelowMarks = 1.8;  // iBUG marks a brow's upper border; its middle lies this far below, units

bool is_mouth(FeatureId id) { return id == FeatureId::kMouthOuter; }

// Found by looking at where the contours settle on the clips and on the talker; the contrast sets the scale.
constexpr SnakeWeights kMouthWeights = {
    .tension = 0.0012, .rigidity = 0.002, .temporal = 0.004, .shape = 0.012, .repulsion = 0.10, .contrast = 1, .change = 0.05};
constexpr SnakeWeights kBrowWeights = {
    .tension = 2e-5, .rigidity = 4e-5, .temporal = 0.02, .shape = 4e-4, .repulsion = 0.05, .contrast = 1, .change = 0};

/// Control points whose curve passes nearest to the feature's vertices, with a little rigidity where the vertices
/// leave it open.
std::vector<glm::dvec2> fit_control(const Feature& f, const SnakeCurve& curve, const std::vector<glm::dvec2>& target) {
  const int n = curve.controls();
  cv::Mat1d a = cv::Mat1d::zeros(n, n), b = cv::Mat1d::zeros(n, 2);
  const auto add = [&](const SplineBasis& basis, const std::array<double, 4>& weight, double w, glm::dvec2 value) {
    for (std::size_t i = 0; i < 4; ++i) {
      b(basis.control[i], 0) += w * weight[i] * value.x;
      b(basis.control[i], 1) += w * weight[i] * value.y;
      for (std::size_t j = 0; j < 4; ++j) a(basis.control[i], basis.control[j]) += w * weight[i] * weight[j];
    }
  };
  for (std::size_t k = 0; k < f.vertices.size(); ++k) {
    const double s = static_cast<double>(f.vertices[k].s);
    const SplineBasis basis = f.closed ? closed_basis(n, s) : clamped_basis(true, s);
    add(basis, basis.value, 1, target[k]);
  }
  for (const SplineBasis& basis : curve.points()) add(basis, basis.d2, 1e-4, {0, 0});
  cv::Mat1d x;
  cv::solve(a, b, x, cv::DECOMP_CHOLESKY);
  std::vector<glm::dvec2> control;
  for (int i = 0; i < n; ++i) control.emplace_back(x(i, 0), x(i, 1));
  return control;
}

std::vector<cv::Point> polygon(const SnakeCurve& curve, const std::vector<glm::dvec2>& control, glm::dvec2 origin) {
  std::vector<cv::Point> out;
  for (const SplineBasis& b : curve.points()) {
    const glm::dvec2 p = (curve_point(b, control) - origin) * kPxPerUnit;
    out.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
  }
  return out;
}

}  // namespace

FeatureTracker::Snake FeatureTracker::make(FeatureId id, const Geometry& geometry) {
  const Feature& f = feature(id);
  Snake s{id, is_mouth(id) ? SnakeCurve::closed(f.control_count, kLipPoints) : SnakeCurve::clamped(kBrowPoints),
          is_mouth(id) ? kMouthWeights : kBrowWeights, {}, 0, {}, {}, {}, {}, {}, 0};
  std::vector<glm::dvec2> target;
  for (const FeatureVertex& v : f.vertices) {
    const glm::dvec3 p(geometry.positions[static_cast<std::size_t>(v.vertex)]);
    target.push_back(glm::dvec2(p.x, p.y) / kHeadUnitsPerSnakeUnit + glm::dvec2(0, is_mouth(id) ? 0 : kBrowBelowMarks));
    s.depth += p.z / static_cast<double>(f.vertices.size());
  }
  s.rest = s.now = fit_control(f, s.curve, target);
  const auto [x0, x1] = std::minmax_element(target.begin(), target.end(), [](auto a, auto b) { return a.x < b.x; });
  const auto [y0, y1] = std::minmax_element(target.begin(), target.end(), [](auto a, auto b) { return a.y < b.y; });
  const double above = is_mouth(id) ? 9 : 10, below = is_mouth(id) ? 16 : 7, aside = is_mouth(id) ? 9 : 6;
  s.region = {x0->x - aside, y0->y - above, x1->x - x0->x + 2 * aside, y1->y - y0->y + above + below};

  const auto add_pair = [&](int from, int to, glm::dvec2 direction, double share) {
    const glm::dvec2 gap = curve_point(s.curve.points()[static_cast<std::size_t>(to)], s.rest) -
                           curve_point(s.curve.points()[static_cast<std::size_t>(from)], s.rest);
    s.facing.push_back({from, to, direction, share * (gap.x * direction.x + gap.y * direction.y)});
  };
  if (is_mouth(id)) {
    // Upper points lie at s in (0, 5), the lower that faces each at 10 - s. An open mouth may close: its gap counts
    // only as far as lips are thick.
    constexpr double kThickLips = 11;  // snake units, both lips together
    for (int h = 3; h <= kLipPoints / 2 - 3; ++h) {
      add_pair(h, kLipPoints - h, {0, 1}, kLipLeastGap);
      s.facing.back().least_gap = std::min(s.facing.back().least_gap, kLipLeastGap * kThickLips);
    }
    add_pair(0, kLipPoints / 2, {1, 0}, kMouthLeastWidth);
  } else {
    add_pair(0, kBrowPoints - 1, {1, 0}, kBrowLeastLength);
  }
  return s;
}

std::array<cv::Mat, 3> FeatureTracker::patch(const Snake& s, const WorkFrame& frame, const Pose& pose) {
  // The feature lies in a plane of constant depth, which the pose maps to the picture affinely.
  const PoseProjection projection(pose);
  const auto work = [&](glm::dvec2 snake) {
    return frame.to_work(projection(glm::dvec3(snake * kHeadUnitsPerSnakeUnit, s.depth)));
  };
  const glm::dvec2 corner(s.region.x, s.region.y);
  const glm::dvec2 o = work(corner), ex = work(corner + glm::dvec2(1 / kPxPerUnit, 0)) - o,
                   ey = work(corner + glm::dvec2(0, 1 / kPxPerUnit)) - o;
  const cv::Matx23d m(ex.x, ey.x, o.x, ex.y, ey.y, o.y);
  const cv::Size size(static_cast<int>(s.region.width * kPxPerUnit), static_cast<int>(s.region.height * kPxPerUnit));
  std::array<cv::Mat, 3> out;
  const std::array<const cv::Mat*, 3> source = {&frame.luma, &frame.u, &frame.v};
  for (std::size_t k = 0; k < 3; ++k)
    cv::warpAffine(*source[k], out[k], m, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return out;
}

void FeatureTracker::learn(Snake& s, const std::array<cv::Mat, 3>& patch) {
  const glm::dvec2 origin(s.region.x, s.region.y);
  const auto outline = polygon(s.curve, s.rest, origin);
  cv::Mat inside = cv::Mat::zeros(patch[0].size(), CV_8UC1), near_by = inside.clone();
  const auto disc = [](double radius) {
    const int r = std::max(1, static_cast<int>(std::lround(radius * kPxPerUnit)));
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * r + 1, 2 * r + 1});
  };
  if (is_mouth(s.id)) {
    cv::fillPoly(inside, std::vector<std::vector<cv::Point>>{outline}, 255);
    cv::Mat grown;
    cv::dilate(inside, near_by, disc(4));
    cv::dilate(inside, grown, disc(1));
    near_by -= grown;
  } else {
    cv::polylines(inside, outline, false, 255, static_cast<int>(std::lround(2 * kPxPerUnit)));
    cv::Mat grown;
    cv::dilate(inside, near_by, disc(4.5));
    cv::dilate(inside, grown, disc(2));
    near_by -= grown;
  }
  s.map = FeatureMap::learn(patch, inside, near_by, !is_mouth(s.id));
}

SnakeImage FeatureTracker::look(Snake& s, const std::array<cv::Mat, 3>& patch) {
  cv::Mat1f map = s.map(patch);
  cv::GaussianBlur(map, map, {}, kBlur * kPxPerUnit);
  SnakeImage image;
  image.origin = {s.region.x, s.region.y};
  image.px_per_unit = kPxPerUnit;
  if (is_mouth(s.id)) {
    // Central differences, per snake unit.
    const cv::Matx13f dx(-0.5F, 0, 0.5F);
    const cv::Matx31f dy(-0.5F, 0, 0.5F);
    cv::filter2D(map, image.contrast_x, CV_32F, dx * static_cast<float>(kPxPerUnit));
    cv::filter2D(map, image.contrast_y, CV_32F, dy * static_cast<float>(kPxPerUnit));
  } else {
    // Centre less surround: largest along the middle of a band as wide as a brow.
    cv::Mat1f wide;
    cv::GaussianBlur(map, wide, {}, 3 * kPxPerUnit);
    image.ridge = map - wide;
  }
  image.change = s.seen.empty() ? cv::Mat1f(cv::Mat1f::zeros(map.size())) : cv::Mat1f(cv::abs(map - s.seen));
  s.seen = map;
  return image;
}

FeatureTracker::FeatureTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first) {
  for (std::size_t v = 0; v < kVertexCount; ++v) neutral_[v] = glm::dvec3(geometry.positions[v]);
  for (const FeatureId id : kSnakeFeatures) {
    Snake s = make(id, geometry);
    const auto seen = patch(s, first, pose);
    learn(s, seen);
    const SnakeImage image = look(s, seen);
    // The rest shape is where the snake settles, so that its own pull on the curve cancels out of all offsets.
    const SnakeOutcome settled = BSnake(s.curve, image, s.weights, s.rest, s.rest, s.facing).minimise(s.rest);
    s.rest = s.now = settled.control;
    s.iterations = settled.iterations;
    snakes_.push_back(std::move(s));
  }
}

std::vector<glm::dvec2> FeatureTracker::predict(const Snake& s, const Pose& pose,
                                                const std::array<glm::dvec2, kVertexCount>& flow) const {
  // Least squares: which offsets of the control points move the feature's vertices as the flow did.
  const PoseProjection projection(pose);
  const glm::dmat2 to_picture(glm::dvec2(projection.matrix[0]), glm::dvec2(projection.matrix[1]));
  const double det = to_picture[0].x * to_picture[1].y - to_picture[1].x * to_picture[0].y;
  if (std::abs(det) < 1e-12) return s.now;
  const Feature& f = feature(s.id);
  const int n = s.curve.controls();
  cv::Mat1d a = cv::Mat1d::eye(n, n) * 0.15, b = cv::Mat1d::zeros(n, 2);  // what the flow leaves open stays
  for (const FeatureVertex& fv : f.vertices) {
    const auto v = static_cast<std::size_t>(fv.vertex);
    if (std::isnan(flow[v].x)) continue;
    const double param = static_cast<double>(fv.s);
    const SplineBasis basis = f.closed ? closed_basis(n, param) : clamped_basis(true, param);
    const glm::dvec2 offset = curve_point(basis, s.now) - curve_point(basis, s.rest);
    const glm::dvec3 here = neutral_[v] + glm::dvec3(offset * kHeadUnitsPerSnakeUnit, 0);
    const glm::dvec2 d = flow[v] - projection(here);
    glm::dvec2 moved(to_picture[1].y * d.x - to_picture[1].x * d.y, -to_picture[0].y * d.x + to_picture[0].x * d.y);
    moved /= det * kHeadUnitsPerSnakeUnit;
    if (std::hypot(moved.x, moved.y) > 8) continue;  // a quarter of the eye distance in one picture: the flow is lost
    for (std::size_t i = 0; i < 4; ++i) {
      b(basis.control[i], 0) += basis.value[i] * moved.x;
      b(basis.control[i], 1) += basis.value[i] * moved.y;
      for (std::size_t j = 0; j < 4; ++j) a(basis.control[i], basis.control[j]) += basis.value[i] * basis.value[j];
    }
  }
  cv::Mat1d x;
  cv::solve(a, b, x, cv::DECOMP_CHOLESKY);
  std::vector<glm::dvec2> out = s.now;
  for (int i = 0; i < n; ++i) out[static_cast<std::size_t>(i)] += glm::dvec2(x(i, 0), x(i, 1));
  return out;
}

void FeatureTracker::track(const WorkFrame& now, const Pose& pose, const std::array<glm::dvec2, kVertexCount>& flow) {
  for (Snake& s : snakes_) {
    const SnakeImage image = look(s, patch(s, now, pose));
    const BSnake snake(s.curve, image, s.weights, s.rest, s.now, s.facing);
    const auto predicted = predict(s, pose, flow);
    const SnakeOutcome settled = snake.minimise(snake.energy(predicted) < snake.energy(s.now) ? predicted : s.now);
    s.now = settled.control;
    s.iterations = settled.iterations;
  }
}

std::array<glm::dvec2, kControlCount> FeatureTracker::offsets() const {
  std::array<glm::dvec2, kControlCount> out{};
  for (const Snake& s : snakes_) {
    const auto first = static_cast<std::size_t>(feature(s.id).first_control);
    for (std::size_t i = 0; i < s.now.size(); ++i) out[first + i] = (s.now[i] - s.rest[i]) * kHeadUnitsPerSnakeUnit;
  }
  return out;
}

void FeatureTracker::set_offsets(const std::array<glm::dvec2, kControlCount>& offsets) {
  for (Snake& s : snakes_) {
    const auto first = static_cast<std::size_t>(feature(s.id).first_control);
    for (std::size_t i = 0; i < s.now.size(); ++i) s.now[i] = s.rest[i] + offsets[first + i] / kHeadUnitsPerSnakeUnit;
  }
}

std::vector<glm::dvec3> FeatureTracker::outline(std::size_t snake) const {
  const Snake& s = snakes_[snake];
  std::vector<glm::dvec3> out;
  for (const SplineBasis& b : s.curve.points())
    out.emplace_back(curve_point(b, s.now) * kHeadUnitsPerSnakeUnit, s.depth);
  return out;
}

}  // namespace fbs
