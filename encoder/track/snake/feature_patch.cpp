#include "encoder/track/snake/feature_patch.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "encoder/track/snake/snake_kinds.h"

namespace fbs {
namespace {

/// Maps the patch's pixels to the work frame's.
cv::Matx23d to_work(const WorkFrame& frame, const Pose& pose, const PatchPlane& plane) {
  const PoseProjection projection(pose);
  const auto work = [&](glm::dvec2 snake) {
    return frame.to_work(projection(glm::dvec3(snake * kHeadUnitsPerSnakeUnit, plane.depth)));
  };
  const glm::dvec2 corner(plane.region.x, plane.region.y);
  const glm::dvec2 o = work(corner), ex = work(corner + glm::dvec2(1 / kPatchPxPerUnit, 0)) - o,
                   ey = work(corner + glm::dvec2(0, 1 / kPatchPxPerUnit)) - o;
  return {ex.x, ey.x, o.x, ex.y, ey.y, o.y};
}

/// Rows that a patch is sampled from, with the neighbours for interpolation; at least one.
cv::Range rows_of(const cv::Matx23d& m, cv::Size patch, int rows) {
  constexpr double kMargin = 2;
  const double across = m(1, 0) * patch.width, down = m(1, 1) * patch.height;
  const double first = m(1, 2) + std::min(across, 0.0) + std::min(down, 0.0) - kMargin;
  const double last = m(1, 2) + std::max(across, 0.0) + std::max(down, 0.0) + kMargin;
  const int start = static_cast<int>(std::clamp(first, 0.0, rows - 1.0));
  return {start, std::max(start + 1, static_cast<int>(std::clamp(last + 1, 0.0, 1.0 * rows)))};
}

void warp(const cv::Mat& source, const cv::Matx23d& to_source, cv::Size size, cv::Mat& patch) {
  cv::warpAffine(source, patch, to_source, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
}

}  // namespace

FeaturePatch cut_patch(const WorkFrame& frame, const Pose& pose, const PatchPlane& plane, bool luma_only) {
  const cv::Matx23d m = to_work(frame, pose, plane);
  const cv::Size size(static_cast<int>(plane.region.width * kPatchPxPerUnit),
                      static_cast<int>(plane.region.height * kPatchPxPerUnit));
  FeaturePatch out;
  if (luma_only) {
    warp(frame.luma, m, size, out[0]);
    return out;
  }
  // All planes at once: most of the work is finding the position. Only the rows that the patch needs are
  // combined.
  const cv::Range rows = rows_of(m, size, frame.luma.rows);
  cv::Mat together, patch;
  cv::merge(std::array{frame.luma.rowRange(rows), frame.u.rowRange(rows), frame.v.rowRange(rows)}, together);
  warp(together, {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2) - rows.start}, size, patch);
  cv::split(patch, out);
  return out;
}

}  // namespace fbs
