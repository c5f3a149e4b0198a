#include "encoder/segment/segment_renderer.h"

#include "decoder/blend/picture_blend.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

std::int32_t mouth_gap_of(const State& state, const SceneGeometry& geometry) {
  return mouth_gap(geometry.geometry(), state);
}

}  // namespace

SegmentRenderer::SegmentRenderer(const SegmentPatterns& patterns) : patterns_(patterns) {
  const Plane& any = patterns.scene.patterns.front().picture.y;
  luma_ = Plane(any.width, any.height);
  scene_.setup.mouth = patterns.scene.mouth;
  scene_.geometry = patterns.scene.geometry;
  for (const Pattern& p : patterns.scene.patterns)
    mouth_gaps_.push_back(mouth_gap_of(p.seen, patterns.scene.geometry));
}

void SegmentRenderer::begin_group(std::size_t group) {
  const AvailablePatterns& wanted = patterns_.available[group];
  scene_.patterns.clear();
  for (const std::size_t pattern : wanted) scene_.patterns.share(patterns_.scene.patterns, pattern);
  slots_ = wanted;
}

Result<const Plane*> SegmentRenderer::draw(const State& state, const SampleArea& area) {
  if (auto drawn = renderer_.render_luma(scene_, state, area, luma_); !drawn) return fail(drawn.error());
  return &luma_;
}

double SegmentRenderer::interior_opacity(const State& state) const {
  std::vector<const State*> seen;
  for (const Pattern& p : scene_.patterns) seen.push_back(&p.seen);
  const std::int32_t gap = mouth_gap_of(state, patterns_.scene.geometry);
  const PictureBlend blend = blend_picture(seen, state);
  double sum = 0;
  for (const WeightedSource& s : blend[static_cast<std::size_t>(Region::kMouth)])
    if (!s.source.still) sum += s.weight * fbs::interior_opacity(gap, mouth_gaps_[slots_[s.source.pattern]]);
  return sum / (double{kBlendOne} * kInteriorOpaque);
}

}  // namespace fbs
