#include "decoder/head/face_light.h"

#include <algorithm>

#include "decoder/head/fixed_math.h"
#include "decoder/head/head_projection.h"

namespace fbs {

VertexLight light_at(glm::ivec3 point, const std::array<std::int32_t, kLightCount>& light) {
  const std::int64_t x = point.x, y = point.y, from_middle = y - kFaceMiddle;
  const std::int64_t slope = light[kLightSlopeX] * x + light[kLightSlopeY] * y;
  const std::int64_t quadratic = light[kLightQuadraticXX] * x * x +
                                 light[kLightQuadraticYY] * from_middle * from_middle +
                                 light[kLightQuadraticXY] * x * from_middle;
  const std::int64_t offset =
      light[kLightOffset] + round_shift(slope, kHeadOneLog2) + round_shift(quadratic, 2 * kHeadOneLog2);
  return {static_cast<std::int32_t>(std::clamp<std::int64_t>(offset, -kMaxLight, kMaxLight)),
          light[kLightGain]};
}

std::vector<VertexLight> vertex_lights(std::span<const glm::ivec3> positions, std::size_t ring,
                                       const std::array<std::int32_t, kLightCount>& light) {
  std::vector<VertexLight> out;
  if (std::all_of(light.begin(), light.end(), [](std::int32_t v) { return v == 0; })) return out;
  out.resize(positions.size() + ring);
  for (std::size_t v = 0; v < positions.size(); ++v) out[v] = light_at(positions[v], light);
  return out;
}

}  // namespace fbs
