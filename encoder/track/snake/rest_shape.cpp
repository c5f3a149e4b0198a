#include "encoder/track/snake/rest_shape.h"

#include <algorithm>
#include <span>

#include "encoder/find/landmarks.h"
#include "encoder/track/snake/control_fit.h"
#include "encoder/track/snake/snake_kinds.h"

namespace fbs {
namespace {

constexpr int kCornerPoints = 3;  // points of the curve on either side of a mouth's corner that face none

glm::dvec2 on_head(const Geometry& geometry, std::size_t vertex) {
  const glm::dvec3 p(geometry.positions[vertex]);
  return glm::dvec2(p.x, p.y) / kHeadUnitsPerSnakeUnit;
}

/// Landmarks at the ends of an upper lid, in order of s.
std::array<int, 2> corners_of(FeatureId id) {
  return id == FeatureId::kUpperLidLeft ? std::array{ibug::kLeftEyeInner, ibug::kLeftEyeOuter}
                                        : std::array{ibug::kRightEyeOuter, ibug::kRightEyeInner};
}

/// The feature's extent plus the margin of its kind.
cv::Rect2d region_of(const SnakeKind& kind, std::span<const glm::dvec2> extent) {
  const auto [x0, x1] =
      std::minmax_element(extent.begin(), extent.end(), [](auto a, auto b) { return a.x < b.x; });
  const auto [y0, y1] =
      std::minmax_element(extent.begin(), extent.end(), [](auto a, auto b) { return a.y < b.y; });
  return {x0->x - kind.aside, y0->y - kind.above, x1->x - x0->x + 2 * kind.aside,
          y1->y - y0->y + kind.above + kind.below};
}

FacingPair facing_pair(const SnakeCurve& curve, const std::vector<glm::dvec2>& rest, int from, int to,
                       glm::dvec2 direction, double share) {
  const glm::dvec2 gap = curve_point(curve.points()[to], rest) - curve_point(curve.points()[from], rest);
  return {from, to, direction, share * (gap.x * direction.x + gap.y * direction.y)};
}

}  // namespace

SnakeCurve curve_of(FeatureId id) {
  const Feature& f = feature(id);
  const int points = kind_of(id).points;
  return f.closed ? SnakeCurve::closed(f.control_count, points) : SnakeCurve::clamped(points, is_brow(id));
}

RestShape rest_shape(FeatureId id, const SnakeCurve& curve, const Geometry& geometry) {
  const Feature& f = feature(id);
  RestShape out;
  out.below_vertices = is_brow(id) ? kBrowBelowMarks : 0;
  std::vector<glm::dvec2> extent;
  for (const FeatureVertex& v : f.vertices) {
    extent.push_back(on_head(geometry, v.vertex) + glm::dvec2(0, out.below_vertices));
    out.plane.depth += geometry.positions[v.vertex].z / static_cast<double>(f.vertices.size());
  }
  const auto corner = corners_of(id);
  std::array<glm::dvec2, 2> ends{};
  for (std::size_t k = 0; k < 2; ++k) ends[k] = on_head(geometry, vertex_of_landmark(corner[k]));
  out.control = fit_control(f, curve, extent, ends);
  if (is_upper_lid(id)) {
    extent.insert(extent.end(), ends.begin(), ends.end());
    const int lower = id == FeatureId::kUpperLidLeft ? ibug::kLeftLowerLid : ibug::kRightLowerLid;
    out.lowest = -kLidsApart;
    for (const int k : {lower, lower + 1}) out.lowest += on_head(geometry, vertex_of_landmark(k)).y / 2;
  }
  out.plane.region = region_of(kind_of(id), extent);
  return out;
}

std::vector<FacingPair> facing_pairs(FeatureId id, const SnakeCurve& curve,
                                     const std::vector<glm::dvec2>& rest) {
  const int points = static_cast<int>(curve.points().size());
  if (is_brow(id)) return {facing_pair(curve, rest, 0, points - 1, {1, 0}, kMinBrowLength)};
  if (!curve.is_closed()) return {};
  // Upper points of a closed mouth curve lie at s in (0, n / 2), the lower point facing each at n - s.
  std::vector<FacingPair> out;
  for (int h = kCornerPoints; h <= points / 2 - kCornerPoints; ++h) {
    FacingPair pair = facing_pair(curve, rest, h, points - h, {0, 1}, kMinLipGap);
    // Inner lips may touch, but not pass each other.
    pair.min_gap = id == FeatureId::kMouthInner ? 0.0 : std::min(pair.min_gap, kMinLipGap * kThickLips);
    out.push_back(pair);
  }
  out.push_back(facing_pair(curve, rest, 0, points / 2, {1, 0}, kMinMouthWidth));
  return out;
}

}  // namespace fbs
