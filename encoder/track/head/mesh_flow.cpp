#include "encoder/track/head/mesh_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "encoder/image/robust.h"
#include "encoder/model/pose_jacobian.h"
#include "encoder/track/head/head_tuning.h"
#include "encoder/track/head/pose_alignment.h"

namespace fbs {

using namespace head_tuning;

MeshFlow mesh_flow(const WorkFrame& before, const WorkFrame& now, const Pose& pose,
                   const HeadVertices& vertices) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr int kCoarsestLevel = 2;
  const PoseProjection projection(pose);
  std::vector<cv::Point2f> from, to;
  for (const glm::dvec3& v : vertices) {
    const glm::dvec2 at = projection(v);
    const glm::dvec2 a = before.to_work(at), b = now.to_work(at);
    from.emplace_back(static_cast<float>(a.x), static_cast<float>(a.y));
    to.emplace_back(static_cast<float>(b.x), static_cast<float>(b.y));
  }
  std::vector<std::uint8_t> found;
  cv::calcOpticalFlowPyrLK(before.luma, now.luma, from, to, found, cv::noArray(), {kFlowWindow, kFlowWindow},
                           kCoarsestLevel, {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 12, 0.02},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  MeshFlow flow;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    flow[v] = found[v] != 0 ? now.to_picture({to[v].x, to[v].y}) : glm::dvec2(kNan);
  return flow;
}

namespace {

/// One step of the fit; false when the flow does not determine a pose.
bool step(const MeshFlow& flow, const HeadVertices& vertices, double eye, double sigma, Pose& pose) {
  const PoseJacobian jacobian(pose);
  cv::Matx66d a =
      pose_precision(eye, kFlowAngleSigma, kFlowShiftSigma) * (kLastFlowSigma * eye * eye * kLastFlowSigma);
  PoseStep b;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (std::isnan(flow[v].x)) continue;
    const glm::dvec2 r = flow[v] - jacobian.projection()(vertices[v]);
    const double w = geman_mcclure_weight((r.x * r.x + r.y * r.y) / (sigma * sigma));
    const auto j = jacobian.at(vertices[v]);
    for (int m = 0; m < 6; ++m) {
      b[m] += w * (j[m].x * r.x + j[m].y * r.y);
      for (int n = 0; n < 6; ++n) a(m, n) += w * (j[m].x * j[n].x + j[m].y * j[n].y);
    }
  }
  PoseStep d;
  if (!cv::solve(a, b, d, cv::DECOMP_CHOLESKY)) return false;
  pose = moved(pose, d);
  return true;
}

}  // namespace

Pose fit_pose(const MeshFlow& flow, const Pose& start, const HeadVertices& vertices) {
  Pose pose = start;
  const double eye = start.eye_distance_px();
  double sigma = kFirstFlowSigma * eye;
  for (int iteration = 0; iteration < kFlowIterations; ++iteration) {
    if (!step(flow, vertices, eye, sigma, pose)) break;
    sigma = std::max(kLastFlowSigma * eye, kFlowSigmaDecay * sigma);
  }
  return pose;
}

}  // namespace fbs
