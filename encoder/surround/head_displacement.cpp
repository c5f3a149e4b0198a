#include "encoder/surround/head_displacement.h"

#include <cmath>

namespace fbs {

std::optional<HeadDisplacement> HeadDisplacement::between(const Pose& seen, const Pose& now) {
  const PoseProjection was(seen), is(now);
  const glm::dmat2 a(glm::dvec2(was.matrix[0]), glm::dvec2(was.matrix[1])),
      b(glm::dvec2(is.matrix[0]), glm::dvec2(is.matrix[1]));
  const double det = a[0][0] * a[1][1] - a[1][0] * a[0][1];
  if (std::abs(det) < 1e-12) return std::nullopt;
  HeadDisplacement out;
  out.linear_ = b * (glm::dmat2(a[1][1], -a[0][1], -a[1][0], a[0][0]) / det);
  out.seen_origin_ = seen.shift;
  out.now_origin_ = now.shift;
  return out;
}

}  // namespace fbs
