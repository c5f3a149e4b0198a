#include "encoder/track/landmark_expression.h"

#include "common/ibug.h"
#include "encoder/model/expression_prior.h"

namespace fbs {
namespace {

constexpr double kFoundSigma = 0.02;  ///< of a landmark, eye distances
constexpr double kLidSigma = 0.1;     ///< of a lid's control point about rest, eye distances

/// Whether a landmark moves with the head only: nose and corners of the eyes.
bool is_rigid(int landmark) {
  return (landmark >= ibug::kNoseFirst && landmark < ibug::kNoseEnd) || landmark == ibug::kRightEyeOuter ||
         landmark == ibug::kRightEyeInner || landmark == ibug::kLeftEyeInner ||
         landmark == ibug::kLeftEyeOuter;
}

bool is_pupil(int control) {
  return control >= feature(FeatureId::kPupilRight).first_control;
}

/// The inverse covariance of all offsets about rest, per squared eye distance.
cv::Mat1d precision_at_rest() {
  cv::Mat1d all(cv::Mat1d::eye(kCoefficientCount, kCoefficientCount) / (kLidSigma * kLidSigma));
  const cv::Mat1d& prior = expression_precision();
  prior.copyTo(all(cv::Rect(0, 0, prior.cols, prior.rows)));
  return all;
}

/// Mean over the rigid landmarks.
glm::dvec2 rigid_mean(const std::array<glm::dvec2, kLandmarkCount>& landmarks) {
  glm::dvec2 sum(0);
  int count = 0;
  for (int k = 0; k < kLandmarkCount; ++k)
    if (is_rigid(k)) {
      sum += landmarks[static_cast<std::size_t>(k)];
      ++count;
    }
  return sum / static_cast<double>(count);
}

}  // namespace

LandmarkExpression::HeadLandmarks LandmarkExpression::displacements(const LandmarkPoints& seen,
                                                                    const Pose& pose) const {
  const PoseProjection projection(pose);
  const glm::dmat2 to_head = glm::inverse(glm::dmat2(projection.matrix));
  HeadLandmarks out;
  for (int k = 0; k < kLandmarkCount; ++k) {
    const auto n = static_cast<std::size_t>(k);
    out[n] = to_head * (seen[n] - projection(rest_[vertex_of_landmark(k)])) /
                 static_cast<double>(kUnitsPerEyeDistance) -
             bias_[n];
  }
  const glm::dvec2 moved = rigid_mean(out);
  for (glm::dvec2& d : out) d -= moved;
  return out;
}

void LandmarkExpression::calibrate(const LandmarkPoints& seen, const Pose& pose, const Offsets& offsets) {
  bias_ = {};
  bias_ = displacements(seen, pose);
  const HeadVertices shown = skinned(geometry_, offsets);
  for (int k = 0; k < kLandmarkCount; ++k) {
    const std::size_t v = vertex_of_landmark(k);
    bias_[static_cast<std::size_t>(k)] -=
        glm::dvec2(shown[v] - rest_[v]) / static_cast<double>(kUnitsPerEyeDistance);
  }
  calibrated_ = true;
}

Offsets LandmarkExpression::offsets(const LandmarkPoints& seen, const Pose& pose) const {
  const HeadLandmarks wanted = displacements(seen, pose);
  static const cv::Mat1d at_rest = precision_at_rest();
  cv::Mat1d normal = at_rest.clone(), right(kCoefficientCount, 1, 0.0);
  for (int k = 0; k < kLandmarkCount; ++k) {
    const glm::dvec2 d = wanted[static_cast<std::size_t>(k)];
    const auto weights = skinning_of(vertex_of_landmark(k));
    for (const SkinningWeight& a : weights) {
      if (is_pupil(a.control)) continue;
      const double wa = a.weight / static_cast<double>(kSkinningOne) / (kFoundSigma * kFoundSigma);
      for (int axis = 0; axis < 2; ++axis) right(2 * a.control + axis) += wa * d[axis];
      for (const SkinningWeight& b : weights)
        for (int axis = 0; axis < 2; ++axis)
          normal(2 * a.control + axis, 2 * b.control + axis) +=
              wa * b.weight / static_cast<double>(kSkinningOne);
    }
  }
  cv::Mat1d solved;
  cv::solve(normal, right, solved, cv::DECOMP_CHOLESKY);
  Offsets out{};
  for (int c = 0; c < kControlCount; ++c)
    if (!is_pupil(c))
      out[static_cast<std::size_t>(c)] =
          glm::dvec2(solved(2 * c), solved(2 * c + 1)) * static_cast<double>(kUnitsPerEyeDistance);
  return out;
}

}  // namespace fbs
