#include "decoder/head/head_deformation.h"

#include <algorithm>
#include <cstdint>

#include "decoder/head/fixed_math.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

constexpr int kSkinningOneLog2 = 12;
static_assert(kSkinningOne == 1 << kSkinningOneLog2);

/// Keeps the pupil's vertex between the lids, a quarter of the gap from either: otherwise a closing eye would
/// fold its triangles.
void keep_between_lids(const WireFrame& head, std::vector<glm::ivec3>& vertices, FeatureId upper_lid,
                       FeatureId lower_lid, FeatureId pupil) {
  const auto y_of = [&](const FeatureVertex& v) { return vertices[v.vertex].y; };
  std::int32_t upper = INT32_MIN, lower = INT32_MAX;
  for (const FeatureVertex& v : head.feature(upper_lid).vertices) upper = std::max(upper, y_of(v));
  for (const FeatureVertex& v : head.feature(lower_lid).vertices) lower = std::min(lower, y_of(v));
  std::int32_t& y = vertices[head.feature(pupil).vertices.front().vertex].y;
  const std::int32_t margin = (lower - upper) / 4;
  y = lower > upper ? std::clamp(y, upper + margin, lower - margin) : upper + (lower - upper) / 2;
}

}  // namespace

std::vector<glm::ivec3> deform(const Geometry& neutral, const State& state) {
  const WireFrame& head = neutral.wire_frame();
  std::vector<glm::ivec3> out = neutral.positions;
  for (std::size_t v = 0; v < out.size(); ++v) {
    std::int64_t x = 0, y = 0;
    for (const SkinningWeight& skinning : head.skinning_of(v)) {
      const glm::ivec2 c = state.control[skinning.control];
      x += std::int64_t{skinning.weight} * c.x;
      y += std::int64_t{skinning.weight} * c.y;
    }
    out[v].x += static_cast<std::int32_t>(round_shift(x, kSkinningOneLog2));
    out[v].y += static_cast<std::int32_t>(round_shift(y, kSkinningOneLog2));
  }
  keep_between_lids(head, out, FeatureId::kUpperLidRight, FeatureId::kLowerLidRight, FeatureId::kPupilRight);
  keep_between_lids(head, out, FeatureId::kUpperLidLeft, FeatureId::kLowerLidLeft, FeatureId::kPupilLeft);
  return out;
}

std::vector<glm::ivec3> project_vertices(const Geometry& neutral, const State& state) {
  const HeadProjection projection(head_pose(state));
  std::vector<glm::ivec3> points = deform(neutral, state);
  for (glm::ivec3& p : points) p = projection(p);
  return points;
}

}  // namespace fbs
