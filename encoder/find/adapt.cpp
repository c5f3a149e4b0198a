#include "encoder/find/adapt.h"

#include <algorithm>
#include <cmath>

#include "encoder/find/edge_distances.h"
#include "encoder/find/elastic_fit.h"
#include "encoder/find/find_tuning.h"
#include "encoder/find/landmarks.h"
#include "encoder/image/robust.h"

namespace fbs {

using namespace find_tuning;

namespace {

constexpr double kUnits = kUnitsPerEyeDistance;

/// The generic head from the front, eye distances.
FrontPoints generic_points() {
  FrontPoints out(kVertexCount);
  for (std::size_t v = 0; v < kVertexCount; ++v) out[v] = glm::dvec2(generic_vertex(v));
  return out;
}

/// Roll, shift and scale that make the eyes level and one unit apart.
Pose pose_of_eyes(const std::array<glm::dvec2, 2>& eyes) {
  const glm::dvec2 across = eyes[1] - eyes[0];
  Pose pose;
  pose.roll = std::atan2(across.y, across.x);
  pose.log2_scale = std::log2(std::hypot(across.x, across.y));
  pose.shift = 0.5 * (eyes[0] + eyes[1]);
  return pose;
}

/// Whether a face in a picture can have this mark; a caller's marks may be any numbers.
bool is_position(glm::dvec2 mark) {
  return std::abs(mark.x) <= kMaxMarkPx && std::abs(mark.y) <= kMaxMarkPx;
}

/// Marks in the face's frame, eye distances.
FrontMarks levelled(const Marks& marks, const Pose& pose, double eye_distance) {
  const double c = std::cos(pose.roll) / eye_distance, s = std::sin(pose.roll) / eye_distance;
  FrontMarks out(kVertexCount);
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (!marks.vertex[v]) continue;
    const glm::dvec2 d = *marks.vertex[v] - pose.shift;
    out[v] = glm::dvec2(c * d.x + s * d.y, -s * d.x + c * d.y);
  }
  return out;
}

/// Tangent of the yaw, positive towards the picture's left, and width, by robust least squares of
/// x = width * generic x + tangent * depth behind the eyes.
struct YawAndWidth {
  double tangent = 0, width = 1;
};

YawAndWidth yaw_and_width(const FrontMarks& target) {
  YawAndWidth out;
  for (int iteration = 0; iteration < kWidthIterations; ++iteration) {
    double xx = 1, xz = 0, zz = kMarkSigma * kMarkSigma / (kMarkedYawSigma * kMarkedYawSigma), xt = 1, zt = 0;
    for (std::size_t v = 0; v < kVertexCount; ++v) {
      if (!target[v]) continue;
      const glm::dvec3 p = generic_vertex(v);
      const double r = (target[v]->x - out.width * p.x - out.tangent * p.z) / kMarkSigma;
      const double w = cauchy_weight(r * r);
      xx += w * p.x * p.x;
      xz += w * p.x * p.z;
      zz += w * p.z * p.z;
      xt += w * p.x * target[v]->x;
      zt += w * p.z * target[v]->x;
    }
    const double det = xx * zz - xz * xz;
    out.width = std::clamp((zz * xt - xz * zt) / det, kMinHeadScale, kMaxHeadScale);
    out.tangent = std::clamp((xx * zt - xz * xt) / det, -kMaxMarkedTangent, kMaxMarkedTangent);
  }
  return out;
}

/// Scale of one axis that best fits the generic positions to the marks, within anatomical limits.
double axis_scale(const FrontPoints& generic, const FrontMarks& target, int axis) {
  double num = 0, den = 0;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    if (!target[v]) continue;
    num += (*target[v])[axis] * generic[v][axis];
    den += generic[v][axis] * generic[v][axis];
  }
  return den > 0 ? std::clamp(num / den, kMinHeadScale, kMaxHeadScale) : 1.0;
}

/// Removes a yaw from `target`. Yaw narrows x to its cosine, and with it the distance between the eyes; so,
/// in eye distances, x keeps its size, depth adds to it by the tangent and y grows. The head rotates about
/// its own axis, and the eyes stay where they are seen.
void take_out_yaw(double tangent, double depth_scale, double eye_distance, Pose& pose, FrontMarks& target) {
  pose.yaw = std::atan(tangent / depth_scale);
  const double cosine = std::cos(pose.yaw);
  pose.log2_scale -= std::log2(cosine);
  const double aside = eye_distance * tangent * generic_eye_depth();
  pose.shift -= aside * glm::dvec2(std::cos(pose.roll), std::sin(pose.roll));
  for (std::size_t v = 0; v < kVertexCount; ++v)
    if (target[v]) target[v] = {target[v]->x - tangent * generic_vertex(v).z, target[v]->y * cosine};
}

Geometry geometry_of(const FrontPoints& points, double depth_scale) {
  Geometry out;
  for (std::size_t v = 0; v < kVertexCount; ++v)
    out.positions[v] = glm::ivec3(std::lround(points[v].x * kUnits), std::lround(points[v].y * kUnits),
                                  std::lround(generic_head().vertices[v].position.z * depth_scale));
  return out;
}

}  // namespace

Result<AdaptedHead> adapt_head(const Marks& marks) {
  for (const auto& mark : marks.vertex)
    if (mark && !is_position(*mark))
      return fail(ErrorCode::kDegenerateInput, "a mark is too far away, or not a number");
  const auto eyes = marks.eyes();
  if (!eyes) return fail(ErrorCode::kDegenerateInput, "an eye has no mark");
  const glm::dvec2 across = (*eyes)[1] - (*eyes)[0];
  const double eye_distance = std::hypot(across.x, across.y);
  if (eye_distance < kMinEyeDistancePx)
    return fail(ErrorCode::kDegenerateInput, "the eyes are less than 4 pixels apart");

  AdaptedHead out;
  out.pose = pose_of_eyes(*eyes);
  FrontMarks target = levelled(marks, out.pose, eye_distance);
  const FrontPoints generic = generic_points();
  const YawAndWidth yaw = yaw_and_width(target);
  const double depth_scale = 0.5 * (yaw.width + axis_scale(generic, target, 1));
  take_out_yaw(yaw.tangent, depth_scale, eye_distance, out.pose, target);

  const glm::dvec2 scale(axis_scale(generic, target, 0), axis_scale(generic, target, 1));
  FrontPoints scaled(kVertexCount);
  for (std::size_t v = 0; v < kVertexCount; ++v) scaled[v] = generic[v] * scale;
  static const std::vector<float> distances = edge_distances(generic_head());
  const ElasticFit fit = fit_elastically(generic_head(), distances, scaled, target);
  out.iterations = fit.iterations;
  out.geometry = geometry_of(fit.points, depth_scale);
  return out;
}

}  // namespace fbs
