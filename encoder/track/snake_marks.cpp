#include "encoder/track/snake_marks.h"

#include <cmath>

#include "encoder/image/work_frame.h"
#include "encoder/track/feature_tracker.h"

namespace fbs {
namespace {

constexpr double kStrayed = 0.12;  // eye distances from mark to curve: beyond, the curve is on something else

/// A brow's snake on a small face may come to rest on the lid or the hair (claire: brow error 19 % -> 33 % of
/// the eye distance), so brows keep their marks.
bool keeps_its_mark(std::size_t vertex) {
  const int on = generic_head().vertices[vertex].feature;
  return on == static_cast<int>(FeatureId::kBrowRight) || on == static_cast<int>(FeatureId::kBrowLeft);
}

}  // namespace

Result<AdaptedHead> adapt_with_snakes(const Picture& picture, Marks marks) {
  auto adapted = adapt_head(marks);
  if (!adapted) return adapted;
  const double eye = adapted->pose.eye_distance_px();
  const WorkFrame frame = WorkFrame::cut(picture, adapted->pose.shift, eye, true);
  const PoseProjection projection(adapted->pose);
  for (const auto& [vertex, place] : FeatureTracker(adapted->geometry, adapted->pose, frame).vertices()) {
    if (keeps_its_mark(vertex)) continue;
    const glm::dvec2 seen = projection(place),
                     marked = projection(glm::dvec3(adapted->geometry.positions[vertex]));
    if (std::hypot(seen.x - marked.x, seen.y - marked.y) < kStrayed * eye) marks.vertex[vertex] = seen;
  }
  return adapt_head(marks);
}

}  // namespace fbs
