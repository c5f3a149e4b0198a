#include "encoder/retarget/wire_frame_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "encoder/find/edge_distances.h"
#include "encoder/find/elastic_fit.h"

namespace fbs {
namespace {

constexpr double kUnits = kUnitsPerEyeDistance;
/// Vertices of two wire-frames nearer than this are the same place of the head, eye distances.
constexpr double kSamePlace = 0.01;

using Positions = std::vector<glm::dvec3>;  ///< eye distances
/// For each vertex of the frame, the face's vertex at the same place.
using Partners = std::vector<std::optional<std::size_t>>;

Positions positions_of(const WireFrame& frame) {
  Positions out;
  for (const HeadVertex& v : frame.vertices) out.push_back(glm::dvec3(v.position) / kUnits);
  return out;
}

Positions positions_of(const Geometry& geometry) {
  Positions out;
  for (const glm::ivec3& p : geometry.positions) out.push_back(glm::dvec3(p) / kUnits);
  return out;
}

std::optional<std::size_t> nearest(const Positions& to, glm::dvec3 place) {
  std::optional<std::size_t> out;
  double least = kSamePlace * kSamePlace;
  for (std::size_t v = 0; v < to.size(); ++v) {
    const glm::dvec3 d = to[v] - place;
    const double square = d.x * d.x + d.y * d.y + d.z * d.z;
    if (square > least) continue;
    least = square;
    out = v;
  }
  return out;
}

/// Landmarks and pupils correspond by meaning. Other vertices correspond where the two wire-frames, not the
/// face, have them in the same place.
Partners partners(const WireFrame& frame, const WireFrame& face) {
  const Positions at = positions_of(frame), on_face = positions_of(face);
  Partners out;
  for (const glm::dvec3& place : at) out.push_back(nearest(on_face, place));
  for (std::size_t k = 0; k < kLandmarkCount; ++k)
    out[frame.vertex_of_landmark(k)] = face.vertex_of_landmark(k);
  for (std::size_t side = 0; side < 2; ++side)
    out[frame.pupil_vertices()[side]] = face.pupil_vertices()[side];
  return out;
}

/// Scales and shifts one axis of the vertices to fit their partners.
void scale_axis(Positions& points, const Positions& face, const Partners& partner, int axis) {
  double n = 0, x = 0, xx = 0, y = 0, xy = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!partner[v]) continue;
    const double from = points[v][axis], to = face[*partner[v]][axis];
    n += 1, x += from, xx += from * from, y += to, xy += from * to;
  }
  const double spread = n * xx - x * x;
  const double scale = spread > 0 ? (n * xy - x * y) / spread : 1;
  const double shift = (y - scale * x) / n;
  for (glm::dvec3& p : points) p[axis] = scale * p[axis] + shift;
}

void deform(const WireFrame& frame, Positions& points, const Positions& face, const Partners& partner) {
  const std::size_t count = points.size();
  FrontPoints front(count);
  FrontMarks front_marks(count);
  Depths depths(count);
  DepthMarks depth_marks(count);
  for (std::size_t v = 0; v < count; ++v) {
    front[v] = glm::dvec2(points[v]);
    depths[v] = points[v].z;
    if (!partner[v]) continue;
    front_marks[v] = glm::dvec2(face[*partner[v]]);
    depth_marks[v] = face[*partner[v]].z;
  }
  const std::vector<float> distances = edge_distances(frame);
  front = fit_elastically(frame, distances, front, front_marks).points;
  depths = fit_elastically(distances, depths, depth_marks);
  for (std::size_t v = 0; v < count; ++v) points[v] = {front[v].x, front[v].y, depths[v]};
}

}  // namespace

Geometry fit_wire_frame(const Geometry& face, std::shared_ptr<const WireFrame> frame) {
  Positions points = positions_of(*frame);
  const Positions on_face = positions_of(face);
  const Partners partner = partners(*frame, face.wire_frame());
  for (int axis = 0; axis < 3; ++axis) scale_axis(points, on_face, partner, axis);
  deform(*frame, points, on_face, partner);
  Geometry out{.positions = {}, .own_frame = std::move(frame)};
  constexpr double kMost = kMaxCoordinate;
  for (const glm::dvec3& p : points) {
    glm::ivec3& to = out.positions.emplace_back();
    for (int axis = 0; axis < 3; ++axis)
      to[axis] = static_cast<int>(std::lround(std::clamp(p[axis] * kUnits, -kMost, kMost)));
  }
  return out;
}

Result<FaceStream> on_wire_frame(FaceStream face, std::shared_ptr<const WireFrame> frame) {
  auto wire_frame = encode_wire_frame(*frame);
  if (!wire_frame) return fail(wire_frame.error());
  auto geometry = encode_geometry(fit_wire_frame(face.geometry, std::move(frame)));
  if (!geometry) return fail(geometry.error());
  face.wire_frame_payload = std::move(*wire_frame);
  face.geometry_payload = std::move(geometry->payload);
  face.geometry = std::move(geometry->decoded);
  return face;
}

}  // namespace fbs
