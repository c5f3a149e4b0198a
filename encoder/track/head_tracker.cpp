#include "encoder/track/head_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>

#include "encoder/image/bilinear.h"
#include "encoder/image/robust.h"
#include "encoder/model/pose_jacobian.h"

namespace fbs {
namespace {

constexpr double kPointSpacing = 3.0;                           // work pixels between surface points
constexpr std::array<std::size_t, 3> kEvery = {1, 2, 4};        // one of so many aligns; finest level first
constexpr float kMoving = 0.8F, kHair = 0.2F;                   // weights, of one
constexpr int kForeheadAbove = -kUnitsPerEyeDistance * 6 / 10;  // y
constexpr double kDoubtBelow = 0.7;  // correlation under which other poses are tried
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// How strongly the pose is held where it was guessed, per number, as standard deviations in eye distances of
/// motion. Only what the picture does not determine feels it.
cv::Matx66d prior(double eye_distance, double sigma_angle, double sigma_px) {
  cv::Matx66d p = cv::Matx66d::zeros();
  for (int k = 0; k < 3; ++k) p(k, k) = 1 / (sigma_angle * sigma_angle);
  for (int k = 3; k < 5; ++k) p(k, k) = 1 / (sigma_px * sigma_px * eye_distance * eye_distance);
  p(5, 5) = 1 / (sigma_angle * sigma_angle);
  return p;
}

/// Brightness with the light taken out: less the local mean, over the local contrast; 8 bit about 128. A face
/// that turns under a lamp changes its shading, but not its features.
cv::Mat without_light(const cv::Mat& luma) {
  constexpr double kReach = 0.22 * WorkFrame::kWorkEyeDistance;
  constexpr double kLeastContrast = 6;  // grey levels; less is noise and stays flat
  constexpr double kGain = 40;          // of one standard deviation
  // Means over a large Gaussian, at a quarter of the size.
  cv::Mat value, small, mean, variance;
  luma.convertTo(value, CV_32F);
  cv::GaussianBlur(value, value, {3, 3}, 0.8);
  const auto smooth = [&](const cv::Mat& in, cv::Mat& out) {
    cv::resize(in, small, {}, 0.25, 0.25, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, kReach / 4);
    cv::resize(small, out, in.size(), 0, 0, cv::INTER_LINEAR);
  };
  smooth(value, mean);
  value -= mean;
  smooth(value.mul(value), variance);
  variance += kLeastContrast * kLeastContrast;
  cv::sqrt(variance, variance);
  cv::Mat out;
  cv::divide(value, variance, value, kGain);
  value.convertTo(out, CV_8U, 1, 128);
  return out;
}

/// Where head points are seen in a level of a work frame: affine in the point.
struct LevelProjection {
  glm::vec3 x, y;  ///< rows of the matrix
  glm::vec2 shift;

  LevelProjection(const PoseProjection& projection, const WorkFrame& frame, int level) {
    const double scale = frame.scale / (1 << level);
    const glm::dmat3 rows = glm::transpose(projection.matrix * scale);
    x = rows[0];
    y = rows[1];
    shift = on_level(frame.to_work(projection.shift), level);
  }
  [[nodiscard]] glm::vec2 operator()(glm::vec3 p) const {
    return {x.x * p.x + x.y * p.y + x.z * p.z + shift.x, y.x * p.x + y.y * p.y + y.z * p.z + shift.y};
  }
};

/// Sums of the alignment's normal equations, some points at a time so that their loops vectorise. Unknowns:
/// the pose's six numbers, gain and offset of the light.
class AlignmentSums {
 public:
  static constexpr std::size_t kUnknowns = 8;

  /// @param pixels_per_unit  of the level
  AlignmentSums(const PoseJacobian& jacobian, double pixels_per_unit, double sigma)
      : pixels_per_unit_(static_cast<float>(pixels_per_unit)),
        per_variance_(static_cast<float>(1 / (sigma * sigma))) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      glm::dvec3 unit(0);
      unit[static_cast<int>(axis)] = 1;
      const auto by = jacobian.at(unit);
      for (std::size_t m = 0; m < kTurns.size(); ++m) {
        by_x_[m][axis] = static_cast<float>(pixels_per_unit * by[kTurns[m]].x);
        by_y_[m][axis] = static_cast<float>(pixels_per_unit * by[kTurns[m]].y);
      }
    }
  }

  void add(glm::vec3 point, const Sample& s, float seen, float difference, float weight) {
    const std::size_t k = count_++;
    for (std::size_t axis = 0; axis < 3; ++axis) point_[axis][k] = point[static_cast<int>(axis)];
    dx_[k] = s.dx;
    dy_[k] = s.dy;
    seen_[k] = seen;
    difference_[k] = difference;
    weight_[k] = weight;
    if (count_ == kBlock) flush();
  }

  /// Adds to the upper triangle of `a` and to `b`.
  void finish(cv::Matx<double, 8, 8>& a, cv::Vec<double, 8>& b) {
    while (count_ > 0 && count_ % kLanes != 0) weight_[count_++] = 0;
    flush();
    std::size_t k = 0;
    for (int m = 0; m < 8; ++m) {
      for (int n = m; n < 8; ++n) a(m, n) += sums_[k++];
      b[m] += sums_[k++];
    }
  }

 private:
  static constexpr std::size_t kBlock = 64, kLanes = 8;
  static constexpr std::array<std::size_t, 4> kTurns = {0, 1, 2, 5};  // these move a point by where it is
  using Row = float[kBlock];

  void flush() {
    const std::size_t n = count_;
    alignas(16) Row j[kUnknowns + 1], weighted;
    for (std::size_t m = 0; m < kTurns.size(); ++m) {
      const std::array<float, 3> bx = by_x_[m], by = by_y_[m];
      for (std::size_t k = 0; k < n; ++k)
        j[kTurns[m]][k] = dx_[k] * (bx[0] * point_[0][k] + bx[1] * point_[1][k] + bx[2] * point_[2][k]) +
                          dy_[k] * (by[0] * point_[0][k] + by[1] * point_[1][k] + by[2] * point_[2][k]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      j[3][k] = pixels_per_unit_ * dx_[k];
      j[4][k] = pixels_per_unit_ * dy_[k];
      j[6][k] = -seen_[k];
      j[7][k] = -1;
      j[8][k] = difference_[k];
      weight_[k] /= geman_mcclure_divisor(difference_[k] * difference_[k] * per_variance_);
    }
    std::size_t to = 0;
    for (std::size_t m = 0; m < kUnknowns; ++m) {
      for (std::size_t k = 0; k < n; ++k) weighted[k] = weight_[k] * j[m][k];
      for (std::size_t i = m; i < kUnknowns + 1; ++i)
        sums_[to++] += static_cast<double>(dot(weighted, j[i], n));
    }
    count_ = 0;
  }

  static float dot(const Row& a, const Row& b, std::size_t n) {
    alignas(16) float sum[kLanes] = {};
    for (std::size_t k = 0; k < n; k += kLanes)
      for (std::size_t l = 0; l < kLanes; ++l) sum[l] += a[k + l] * b[k + l];
    return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
  }

  float pixels_per_unit_, per_variance_;
  std::array<std::array<float, 3>, 4> by_x_, by_y_;
  alignas(16) Row point_[3] = {}, dx_ = {}, dy_ = {}, seen_ = {}, difference_ = {}, weight_ = {};
  std::size_t count_ = 0;
  std::array<double, kUnknowns*(kUnknowns + 3) / 2> sums_{};  ///< rows of the upper triangle, each with b's
};

/// Middle of the eyes and the nose, head units: what stays in place while a wrong turn is undone.
glm::dvec3 face_centre(const HeadVertices& vertices) {
  const auto at = [&](int ibug) { return vertices[vertex_of_landmark(ibug)]; };
  return (at(36) + at(45) + at(30)) / 3.0;
}

/// What moves by itself says less of the head: lips, eyes, brows, chin; and hair or a hat above the forehead
/// is not where the mesh has it.
float weight_of(const HeadTriangle& t) {
  float least = 1;
  for (const std::uint16_t v : t) {
    const HeadVertex& vertex = generic_head().vertices[v];
    const bool eye = vertex.landmark >= 36 && vertex.landmark < 48;
    const bool chin = vertex.landmark >= 4 && vertex.landmark <= 12;
    if (vertex.feature >= 0 || eye || chin) least = std::min(least, kMoving);
    if (vertex.position.y < kForeheadAbove) least = std::min(least, kHair);
  }
  return least;
}

}  // namespace

LevelledFrame::LevelledFrame(WorkFrame of)
    : frame(std::move(of)), levels(make_pyramid<kLevels>(without_light(frame.luma))) {}

Pose frontal(const Pose& pose, const HeadVertices& vertices) {
  const glm::dvec3 centre = face_centre(vertices);
  Pose out = pose;
  out.pitch = out.yaw = 0;
  out.shift += PoseProjection(pose)(centre) - PoseProjection(out)(centre);
  return out;
}

glm::dvec2 LevelledFrame::at(glm::dvec2 picture, int level) const {
  return on_level(frame.to_work(picture), level);
}

HeadTracker::HeadTracker(const Geometry& geometry, const Pose& pose, const WorkFrame& first)
    : eye_distance_px_(pose.eye_distance_px()), pose_(pose), before_(first) {
  HeadVertices vertices;
  for (std::size_t v = 0; v < kVertexCount; ++v) vertices[v] = glm::dvec3(geometry.positions[v]);
  const PoseProjection projection(pose);
  points_ = spread_over_mesh(vertices, projection, kPointSpacing / first.scale);
  for (const SurfacePoint& p : points_) weight_.push_back(weight_of(p.corner));
  const LevelledFrame levelled(first);
  const std::vector<glm::dvec3> points = surface(vertices);
  for (int level = 0; level < kLevels; ++level) {
    auto& seen = seen_[level];
    for (const glm::dvec3& p : points) {
      const glm::dvec2 x = levelled.at(projection(p), level);
      Sample s;
      const bool inside = sample_with_slope(levelled.levels[level], x, s);
      seen.push_back(inside ? static_cast<float>(s.value) : -1.0F);
    }
  }
}

std::vector<glm::dvec3> HeadTracker::surface(const HeadVertices& vertices) const {
  std::vector<glm::dvec3> out;
  out.reserve(points_.size());
  for (const SurfacePoint& p : points_) out.push_back(p.on(vertices));
  return out;
}

void HeadTracker::follow_flow(const WorkFrame& now, const HeadVertices& vertices) {
  const PoseProjection projection(pose_);
  std::vector<cv::Point2f> from, to;
  for (const glm::dvec3& v : vertices) {
    const glm::dvec2 at = projection(v);
    const glm::dvec2 a = before_.to_work(at), b = now.to_work(at);
    from.emplace_back(static_cast<float>(a.x), static_cast<float>(a.y));
    to.emplace_back(static_cast<float>(b.x), static_cast<float>(b.y));
  }
  std::vector<std::uint8_t> found;
  // On the coarsest of the three levels the window is an eye distance wide.
  cv::calcOpticalFlowPyrLK(before_.luma, now.luma, from, to, found, cv::noArray(), {13, 13}, 2,
                           {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 12, 0.02},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  for (std::size_t v = 0; v < kVertexCount; ++v)
    flow_[v] = found[v] != 0 ? now.to_picture({to[v].x, to[v].y}) : glm::dvec2(kNan);
}

Pose HeadTracker::fit_flow(const Pose& start, const HeadVertices& vertices) const {
  Pose pose = start;
  const double eye = start.eye_distance_px();
  double sigma = 0.08 * eye;
  for (int iteration = 0; iteration < 8; ++iteration, sigma = std::max(0.02 * eye, 0.7 * sigma)) {
    const PoseJacobian jacobian(pose);
    cv::Matx66d a = prior(eye, 0.3, 0.5) * (0.02 * eye * eye * 0.02);
    PoseStep b;
    for (std::size_t v = 0; v < kVertexCount; ++v) {
      if (std::isnan(flow_[v].x)) continue;
      const glm::dvec2 r = flow_[v] - jacobian.projection()(vertices[v]);
      const double q = (r.x * r.x + r.y * r.y) / (sigma * sigma);
      const double w = geman_mcclure_weight(q);
      const auto j = jacobian.at(vertices[v]);
      for (std::size_t m = 0; m < 6; ++m) {
        b[static_cast<int>(m)] += w * (j[m].x * r.x + j[m].y * r.y);
        for (std::size_t n = 0; n < 6; ++n)
          a(static_cast<int>(m), static_cast<int>(n)) += w * (j[m].x * j[n].x + j[m].y * j[n].y);
      }
    }
    PoseStep d;
    if (!cv::solve(a, b, d, cv::DECOMP_CHOLESKY)) break;
    pose = moved(pose, d);
  }
  return pose;
}

Pose HeadTracker::align(const Pyramid<kLevels>& pyramid, const WorkFrame& now, int level, const Pose& start,
                        const std::vector<glm::dvec3>& points) const {
  const cv::Mat& luma = pyramid[level];
  const std::vector<float>& seen = seen_[level];
  const double to_level = now.scale / (1 << level);
  const std::size_t every = kEvery[level];
  const double eye = start.eye_distance_px();
  Pose pose = start;
  double gain = 1, offset = 0, sigma = 20;
  for (int iteration = 0; iteration < 6; ++iteration) {
    const PoseJacobian jacobian(pose);
    cv::Matx<double, 8, 8> a = cv::Matx<double, 8, 8>::zeros();
    cv::Vec<double, 8> b;
    const cv::Matx66d hold = prior(eye, 0.5, 0.5);
    for (int m = 0; m < 6; ++m) a(m, m) = hold(m, m);
    a(6, 6) = 1e4;  // light changes slowly: gain and offset cost what they explain
    a(7, 7) = 1e-1;
    b[6] = 1e4 * (1 - gain);
    float absolute = 0, count = 0;
    const LevelProjection projection(jacobian.projection(), now, level);
    AlignmentSums sums(jacobian, to_level, sigma);
    const auto gain_now = static_cast<float>(gain), offset_now = static_cast<float>(offset);
    for (std::size_t k = 0; k < points.size(); k += every) {
      if (seen[k] < 0) continue;
      const glm::vec3 p(points[k]);
      Sample s;
      if (!sample_with_slope(luma, projection(p), s)) continue;
      const float r = gain_now * seen[k] + offset_now - s.value;
      absolute += std::abs(r);
      ++count;
      const float weight = weight_[k] * static_cast<float>(every) / 25;
      sums.add(p, s, seen[k], r, weight);  // 5 grey levels of noise
    }
    if (count < 50 / static_cast<float>(every)) return start;
    sums.finish(a, b);
    for (int m = 0; m < 8; ++m)
      for (int n = 0; n < m; ++n) a(m, n) = a(n, m);
    cv::Vec<double, 8> d;
    if (!cv::solve(a, b, d, cv::DECOMP_CHOLESKY)) return start;
    pose = moved(pose, {d[0], d[1], d[2], d[3], d[4], d[5]});
    gain = std::clamp(gain + d[6], 0.5, 2.0);
    offset = std::clamp(offset + d[7], -80.0, 80.0);
    sigma = std::clamp(2 * 1.25 * static_cast<double>(absolute / count), 6.0, 30.0);
    const double step =
        std::hypot(d[3], d[4]) / eye + std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) + std::abs(d[5]);
    if (step < 5e-4) break;
  }
  return pose;
}

double HeadTracker::correlation(const LevelledFrame& now, const Pose& pose,
                                std::span<const glm::dvec3> points) const {
  const LevelProjection projection(PoseProjection(pose), now.frame, 1);
  double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Sample s;
    if (seen_[1][k] < 0 || !sample_with_slope(now.levels[1], projection(glm::vec3(points[k])), s)) continue;
    const auto w = static_cast<double>(weight_[k]);
    const auto x = static_cast<double>(seen_[1][k]), y = static_cast<double>(s.value);
    n += w;
    sx += w * x;
    sy += w * y;
    sxx += w * x * x;
    syy += w * y * y;
    sxy += w * x * y;
  }
  if (n < 20) return 0;
  const double vx = sxx - sx * sx / n, vy = syy - sy * sy / n;
  if (vx <= 0 || vy <= 0) return 0;
  return std::clamp((sxy - sx * sy / n) / std::sqrt(vx * vy), 0.0, 1.0);
}

TrackedPose HeadTracker::settle(const LevelledFrame& now, const Pose& pose,
                                const std::vector<glm::dvec3>& points) const {
  constexpr double kMayLose = 0.002;  // correlation that a finer level may cost
  TrackedPose best{pose, correlation(now, pose, points)};
  for (int level = kLevels - 1; level >= 0; --level) {
    const Pose refined = align(now.levels, now.frame, level, best.pose, points);
    const double explained = correlation(now, refined, points);
    if (explained >= best.confidence - kMayLose) best = {refined, explained};
  }
  return best;
}

TrackedPose HeadTracker::track(const WorkFrame& now, const HeadVertices& vertices) {
  follow_flow(now, vertices);
  const LevelledFrame levelled(now);
  const std::vector<glm::dvec3> points = surface(vertices);

  // The flow's guess and the pose before: the alignment starts from the one that explains the picture better.
  const Pose guess = fit_flow(pose_, vertices);
  const bool flowed = correlation(levelled, guess, points) >= correlation(levelled, pose_, points);
  TrackedPose found = settle(levelled, flowed ? guess : pose_, points);
  if (found.confidence < kDoubtBelow) {
    // Perhaps caught in a turn that is none.
    const TrackedPose other = settle(levelled, frontal(found.pose, vertices), points);
    if (other.confidence > found.confidence) found = other;
  }
  pose_ = found.pose;
  before_ = now;
  return found;
}

}  // namespace fbs
