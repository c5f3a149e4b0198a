#include "encoder/track/head/pose_alignment.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "encoder/find/landmarks.h"
#include "encoder/track/head/alignment_sums.h"
#include "encoder/track/head/head_tuning.h"

namespace fbs {

using namespace head_tuning;

namespace {

struct Light {
  double gain = 1, offset = 0;
};

/// The inputs of an alignment, all held by reference.
struct Target {
  const HeadAppearance& head;
  const LevelledFrame& now;
  int level;
  std::span<const glm::dvec3> points;
};

/// Priors of the pose about `start`, of the gain about 1 and of the offset.
void add_priors(double eye_px, const Light& light, AlignmentSums::Matrix& a, AlignmentSums::Vector& b) {
  const cv::Matx66d hold = pose_precision(eye_px, kAlignmentAngleSigma, kAlignmentShiftSigma);
  for (int m = 0; m < 6; ++m) a(m, m) = hold(m, m);
  a(6, 6) = kGainPrecision;
  a(7, 7) = kOffsetPrecision;
  b[6] = kGainPrecision * (1 - light.gain);
}

/// @return mean absolute difference; nothing when too few points are seen
std::optional<float> add_points(const Target& t, const Pose& pose, const Light& light, double outlier,
                                AlignmentSums::Matrix& a, AlignmentSums::Vector& b) {
  const PoseJacobian jacobian(pose);
  const LevelProjection projection(jacobian.projection(), t.now.frame, t.level);
  AlignmentSums sums(jacobian, t.now.frame.scale / level_scale(t.level), outlier);
  const cv::Mat& luma = t.now.levels[t.level];
  const std::span<const float> seen = t.head.seen(t.level), weights = t.head.weights();
  const std::size_t every = kEveryPoint[t.level];
  const auto gain = static_cast<float>(light.gain), offset = static_cast<float>(light.offset);
  float absolute = 0, count = 0;
  for (std::size_t k = 0; k < t.points.size(); k += every) {
    if (seen[k] < 0) continue;
    const glm::vec3 p(t.points[k]);
    Sample s;
    if (!sample_with_slope(luma, projection(p), s)) continue;
    const float r = gain * seen[k] + offset - s.value;
    absolute += std::abs(r);
    ++count;
    sums.add(p, s, seen[k], r, weights[k] * static_cast<float>(every) / kResidualVariance);
  }
  if (count < kMinPoints / static_cast<float>(every)) return std::nullopt;
  sums.finish(a, b);
  return absolute / count;
}

bool solve(AlignmentSums::Matrix& a, const AlignmentSums::Vector& b, AlignmentSums::Vector& step) {
  for (int m = 0; m < AlignmentSums::kUnknowns; ++m)
    for (int n = 0; n < m; ++n) a(m, n) = a(n, m);
  return cv::solve(a, b, step, cv::DECOMP_CHOLESKY);
}

/// Middle of the eyes and the nose, head units: fixed in frontal().
glm::dvec3 face_centre(const HeadVertices& vertices) {
  const auto at = [&](int ibug) { return vertices[vertex_of_landmark(ibug)]; };
  return (at(ibug::kRightEyeOuter) + at(ibug::kLeftEyeOuter) + at(ibug::kNoseTip)) / 3.0;
}

}  // namespace

cv::Matx66d pose_precision(double eye_distance_px, double sigma_angle, double sigma_shift) {
  cv::Matx66d p = cv::Matx66d::zeros();
  for (int k = 0; k < 3; ++k) p(k, k) = 1 / (sigma_angle * sigma_angle);
  for (int k = 3; k < 5; ++k) p(k, k) = 1 / (sigma_shift * sigma_shift * eye_distance_px * eye_distance_px);
  p(5, 5) = 1 / (sigma_angle * sigma_angle);
  return p;
}

Pose align(const HeadAppearance& head, const LevelledFrame& now, int level, const Pose& start,
           std::span<const glm::dvec3> points) {
  const Target target{head, now, level, points};
  const double eye = start.eye_distance_px();
  Pose pose = start;
  Light light;
  double outlier = kFirstOutlier;
  for (int iteration = 0; iteration < kAlignmentIterations; ++iteration) {
    auto a = AlignmentSums::Matrix::zeros();
    AlignmentSums::Vector b, d;
    add_priors(eye, light, a, b);
    const std::optional<float> residual = add_points(target, pose, light, outlier, a, b);
    if (!residual || !solve(a, b, d)) return start;
    pose = moved(pose, {d[0], d[1], d[2], d[3], d[4], d[5]});
    light.gain = std::clamp(light.gain + d[6], kMinGain, kMaxGain);
    light.offset = std::clamp(light.offset + d[7], -kMaxOffset, kMaxOffset);
    outlier = std::clamp(kOutlierPerMean * static_cast<double>(*residual), kMinOutlier, kMaxOutlier);
    const double step =
        std::hypot(d[3], d[4]) / eye + std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) + std::abs(d[5]);
    if (step < kConverged) break;
  }
  return pose;
}

TrackedPose refine(const HeadAppearance& head, const LevelledFrame& now, const Pose& start,
                   std::span<const glm::dvec3> points) {
  TrackedPose best{start, head.correlation(now, start, points)};
  for (int level = LevelledFrame::kLevels - 1; level >= 0; --level) {
    const Pose refined = align(head, now, level, best.pose, points);
    const double explained = head.correlation(now, refined, points);
    if (explained >= best.confidence - kMayLose) best = {refined, explained};
  }
  return best;
}

Pose frontal(const Pose& pose, const HeadVertices& vertices) {
  const glm::dvec3 centre = face_centre(vertices);
  Pose out = pose;
  out.pitch = out.yaw = 0;
  out.shift += PoseProjection(pose)(centre) - PoseProjection(out)(centre);
  return out;
}

}  // namespace fbs
