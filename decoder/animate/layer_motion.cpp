#include "decoder/animate/layer_motion.h"

#include <algorithm>

#include "decoder/head/fixed_math.h"

namespace fbs {
namespace {

/// Below this determinant (Q14) of the upper-left 2 x 2 rotation, the head is seen too far from the side to
/// invert its plane.
constexpr std::int64_t kMinDeterminant = 1 << 11;

constexpr std::int64_t kMaxFactor = 1 << 20;  // Q16: sixteen times

}  // namespace

HeadPlane::HeadPlane(const HeadPose& from, const HeadPose& to) : from_(from), to_(to) {
  if (from == to) return;
  const HeadProjection before(from), after(to);
  const auto& a = after.rotation;
  const auto& b = before.rotation;
  const std::int64_t det =
      round_shift(std::int64_t{b[0][0]} * b[1][1] - std::int64_t{b[0][1]} * b[1][0], kRotationOneLog2);
  if (det < kMinDeterminant) return;
  moves_ = true;
  const std::int64_t ratio = (after.scale << kScaleOneLog2) / before.scale;       // Q16
  const std::int64_t inverse[2][2] = {{b[1][1], -b[0][1]}, {-b[1][0], b[0][0]}};  // times 1 / det
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const std::int64_t q14 = (a[i][0] * inverse[0][j] + a[i][1] * inverse[1][j]) / det;
      matrix_[i][j] =
          std::clamp<std::int64_t>(round_shift(q14 * ratio, kRotationOneLog2), -kMaxFactor, kMaxFactor);
    }
}

glm::ivec2 HeadPlane::displacement(glm::ivec2 p) const {
  if (!moves_) return {0, 0};
  const std::int64_t dx = p.x - from_.shift_x, dy = p.y - from_.shift_y;
  const auto q = [](std::int64_t product) { return round_shift(product, kScaleOneLog2); };
  return {clamp_screen(to_.shift_x + q(matrix_[0][0] * dx + matrix_[0][1] * dy) - p.x),
          clamp_screen(to_.shift_y + q(matrix_[1][0] * dx + matrix_[1][1] * dy) - p.y)};
}

glm::ivec2 similarity_displacement(const std::array<std::int32_t, kSimilarityCount>& from,
                                   const std::array<std::int32_t, kSimilarityCount>& to,
                                   glm::ivec2 from_head) {
  const std::int64_t scale = to[kSimilarityScale] - from[kSimilarityScale],
                     rotation = to[kSimilarityRotation] - from[kSimilarityRotation];
  const auto q = [](std::int64_t product) { return round_shift(product, kFromHeadOneLog2); };
  return {clamp_screen(to[kDisplacementX] - from[kDisplacementX] +
                       q(scale * from_head.x - rotation * from_head.y)),
          clamp_screen(to[kDisplacementY] - from[kDisplacementY] +
                       q(scale * from_head.y + rotation * from_head.x))};
}

}  // namespace fbs
