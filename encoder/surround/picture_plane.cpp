#include "encoder/surround/picture_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bitstream/payload/geometry_payload.h"

namespace fbs {
namespace {

/// Enlargement of the generic head; keeps the coordinates within kMaxCoordinate.
constexpr std::int32_t kEnlarged = 2;

/// Eye distance of the plane over the long side of the picture: room to pan.
constexpr double kEyePerLongSide = 4;

/// Radius of the largest circle about the origin inside the outline of the generic head, eye distances.
constexpr double kInnerRadius = 1.08;

}  // namespace

Result<PicturePlane> PicturePlane::create(const VideoFormat& format) {
  PicturePlane out;
  out.half_diagonal_ = std::hypot(format.width, format.height) / 2;
  out.rest_.shift = {format.width / 2.0, format.height / 2.0};
  const double eye = kEyePerLongSide * std::max(format.width, format.height);
  out.rest_.log2_scale = std::min(std::log2(eye), 12.5);  // below kMaxLogScale: room to zoom
  Geometry flat;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::ivec3 p = generic_head().vertices[v].position;
    flat.positions[v] = {kEnlarged * p.x, kEnlarged * p.y, 0};
  }
  auto coded = encode_geometry(flat);
  if (!coded) return fail(coded.error());
  out.geometry_ = coded->decoded;
  out.payload_ = std::move(coded->payload);
  return out;
}

QuantiserSteps PicturePlane::steps(double step_px) const {
  QuantiserSteps out;
  out.translation = std::max(1, static_cast<std::int32_t>(std::lround(step_px * kStateUnitsPerPixel)));
  const double angle = step_px / half_diagonal_;
  out.rotation = std::max(1, static_cast<std::int32_t>(angle / (2 * std::numbers::pi) * 65536));
  out.log_scale = std::max(1, static_cast<std::int32_t>(angle / std::numbers::ln2 * 4096));
  return out;
}

Pose PicturePlane::pose(const PlaneMotion& motion) const {
  Pose out = rest_;
  out.shift += glm::dvec2(motion.shift.real(), motion.shift.imag());
  out.roll += std::arg(motion.turn);
  out.log2_scale += std::log2(std::abs(motion.turn));
  return out;
}

bool PicturePlane::covers(const PlaneMotion& motion) const {
  const double radius = kInnerRadius * kEnlarged * std::exp2(pose(motion).log2_scale);
  return std::abs(motion.shift) + half_diagonal_ < radius && pose(motion).log2_scale < 13;
}

cv::Matx<double, kPoseCount, kPoseCount> PicturePlane::quadratic(
    const GlobalMotion::Observation& observation) {
  const glm::dvec2 origin(observation.since_first.shift.real(), observation.since_first.shift.imag());
  State unit;
  unit.pose.fill(1);
  const Pose one = pose_of(unit);
  cv::Matx<double, kPoseCount, kPoseCount> out;
  for (const GlobalMotion::Observation::Place& place : observation.places) {
    const glm::dvec2 d = place.at - origin;
    std::array<glm::dvec2, kPoseCount> by{};  // displacement of the place per unit of each number
    by[kRoll] = one.roll * glm::dvec2(-d.y, d.x);
    by[kShiftX] = {one.shift.x, 0};
    by[kShiftY] = {0, one.shift.y};
    by[kLogScale] = one.log2_scale * std::numbers::ln2 * d;
    const auto xx = static_cast<double>(place.structure[0]), xy = static_cast<double>(place.structure[1]),
               yy = static_cast<double>(place.structure[2]);
    for (int i = 0; i < kPoseCount; ++i)
      for (int j = 0; j < kPoseCount; ++j)
        out(i, j) +=
            xx * by[i].x * by[j].x + xy * (by[i].x * by[j].y + by[i].y * by[j].x) + yy * by[i].y * by[j].y;
  }
  return out;
}

}  // namespace fbs
