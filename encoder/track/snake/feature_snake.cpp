#include "encoder/track/snake/feature_snake.h"

#include <cmath>
#include <utility>

#include "encoder/track/snake/feature_masks.h"
#include "encoder/track/snake/snake_filters.h"

namespace fbs {
namespace {

constexpr double kBrowSurround = 3;  // snake units, sigma: makes a band as wide as a brow stand out most

/// The curve at rest, pixels of the patch.
std::vector<cv::Point> outline_of(const FeatureSnake& s) {
  const glm::dvec2 origin(s.plane.region.x, s.plane.region.y);
  std::vector<cv::Point> out;
  for (const SplineBasis& b : s.curve.points()) {
    const glm::dvec2 p = (curve_point(b, s.rest) - origin) * kPatchPxPerUnit;
    out.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
  }
  return out;
}

}  // namespace

FeatureSnake FeatureSnake::make(FeatureId id, const Geometry& geometry) {
  FeatureSnake s{.id = id, .curve = curve_of(id), .weights = kind_of(id).weights};
  const RestShape shape = rest_shape(id, s.curve, geometry);
  s.plane = shape.plane;
  s.rest = s.now = shape.control;
  s.below_vertices = shape.below_vertices;
  s.lowest = shape.lowest;
  s.facing = facing_pairs(id, s.curve, s.rest);
  return s;
}

void FeatureSnake::limit(std::vector<glm::dvec2>& control) const {
  // The middle of a clamped cubic moves by 3/4 of the motion of both inner control points.
  const double beyond = curve_point(clamped_basis(true, 0.5), control).y - lowest;
  if (beyond <= 0) return;
  for (int i = curve.first_free(); i < curve.end_free(); ++i) control[i].y -= beyond / 0.75;
}

FeaturePatch FeatureSnake::patch(const WorkFrame& frame, const Pose& pose) const {
  return cut_patch(frame, pose, plane, is_brow(id));  // hair differs from skin in brightness
}

void FeatureSnake::learn(const FeaturePatch& first) {
  const FeatureMasks masks = feature_masks(id, outline_of(*this), first[0].size());
  if (id == FeatureId::kMouthInner) {
    map = FeatureMap::likeness(first, masks.inside);
    return;
  }
  // Dark lashes are below this edge, but also below the lower lid's lashes; the lid's skin is above this one
  // only.
  if (is_upper_lid(id)) skin = FeatureMap::likeness(first, masks.outside);
  map = FeatureMap::discriminant(first, masks.inside, masks.outside, id != FeatureId::kMouthOuter);
}

SnakeImage FeatureSnake::observe(const FeaturePatch& patch) {
  cv::Mat1f values = map(patch);
  // Half of the difference, so that a lid's edge has the contrast of other features.
  if (skin) cv::addWeighted(values, 0.5, (*skin)(patch), -0.5, 0, values);
  smooth(values, values, kind_of(id).blur);
  if (weights.change != 0) {
    const cv::Mat1f before = std::exchange(seen, values.clone());
    if (!before.empty()) cv::addWeighted(values, 1 + weights.change, before, -weights.change, 0, values);
  }
  SnakeImage image;
  image.origin = {plane.region.x, plane.region.y};
  image.px_per_unit = kPatchPxPerUnit;
  if (is_brow(id)) {
    // Centre less surround: largest along the middle of the band.
    smooth(values, image.ridge, kBrowSurround);
    cv::subtract(values, image.ridge, image.ridge);
  } else {
    // Outer contours have the feature inside them, inner lips outside.
    slopes(values, id == FeatureId::kMouthInner ? -1 : 1, image.contrast_x, image.contrast_y);
  }
  return image;
}

}  // namespace fbs
