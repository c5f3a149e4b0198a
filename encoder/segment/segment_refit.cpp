#include "encoder/segment/segment_refit.h"

#include <algorithm>
#include <utility>

namespace fbs {
namespace {

/// Weight of the state of a pattern's picture relative to others: everything drawn from the pattern depends
/// on its seen state. More costs bits of motion; 3 and 30 gain 0.3 % of the rate less in the face (four
/// clips).
constexpr double kPatternWeight = 10;

constexpr int kFirstSurround = first_of(PartId::kBody);
static_assert(first_of(PartId::kGround) == kFirstSurround + kSimilarityCount);

}  // namespace

SegmentRefit::SegmentRefit(const Setup& setup, const Geometry& geometry, const Pattern& first,
                           double eye_distance_px, MotionTrack motion)
    : fit_(setup, geometry,
           {WorkFrame::cut(first.picture, pose_of(first.seen).shift, eye_distance_px, false), first.seen}),
      before_(std::move(motion)) {}

void SegmentRefit::add(const FaceAnalysis::Observation& picture) {
  Analysed out{picture.state, picture.face, picture.eye_distance_px, {}, {}};
  const PictureCost& cost = picture.cost;
  std::copy_n(cost.fit.begin() + kFirstSurround, kSurroundCount, out.surround.begin());
  for (const LayerCost& layer : cost.layers)
    if (layer.layer == CostLayer::kSurround)
      for (int i = 0; i < kSurroundCount; ++i)
        for (int j = 0; j < kSurroundCount; ++j)
          out.surround_quadratic(i, j) = layer.quadratic(kFirstSurround + i, kFirstSurround + j);
  pictures_.push_back(out);
}

Result<PictureCost> SegmentRefit::head_cost(const Shown& shown, Tools& tools) {
  if (!shown.analysed.face) return cost_unseen(fit_of(shown.pattern ? shown.state : shown.analysed.state));
  const Plane& source = shown.source.y;
  const Fit now = fit_of(shown.state);
  const double eye = shown.analysed.eye_distance_px;
  const cv::Rect crop = WorkFrame::area({source.width, source.height}, now.pose.shift, eye);
  const auto drawn = tools.renderer.draw(shown.state, {crop.x, crop.y, crop.br().x, crop.br().y});
  if (!drawn) return fail(drawn.error());
  const auto frame_of = [&](const Plane& luma) { return WorkFrame::cut(luma, now.pose.shift, eye); };
  PictureFit& fit = tools.fit;
  constexpr int kLevels = 1;
  fit.set_pattern({frame_of(**drawn), shown.state, 0, tools.renderer.interior_opacity(shown.state), kLevels});
  fit.set_picture(frame_of(source), kLevels);
  return shown.pattern ? fit.cost_at(now) : fit.cost_near(now);
}

Result<PictureCost> SegmentRefit::cost_of(const Shown& shown, Tools& tools) {
  auto cost = head_cost(shown, tools);
  if (!cost) return cost;
  std::copy(shown.analysed.surround.begin(), shown.analysed.surround.end(),
            cost->fit.begin() + kFirstSurround);
  LayerCost surround{CostLayer::kSurround, 0, 0, cv::Mat1d(kParameterCount, kParameterCount, 0.0)};
  for (int i = 0; i < kSurroundCount; ++i)
    for (int j = 0; j < kSurroundCount; ++j)
      surround.quadratic(kFirstSurround + i, kFirstSurround + j) = shown.analysed.surround_quadratic(i, j);
  cost->layers.push_back(std::move(surround));
  if (shown.pattern)
    for (LayerCost& layer : cost->layers) layer.quadratic *= kPatternWeight;
  return cost;
}

Result<void> SegmentRefit::run(Segment& segment, const SegmentPatterns& patterns, Workers& workers) {
  MotionTrack motion = before_;
  fit_.set_mouth(patterns.scene.mouth);
  std::vector<Tools> tools;
  tools.reserve(static_cast<std::size_t>(workers.count()));
  for (int k = 0; k < workers.count(); ++k) tools.push_back({fit_, SegmentRenderer(patterns)});
  const auto is_pattern = [&](const State& state) {
    return std::ranges::any_of(patterns.scene.patterns,
                               [&](const Pattern& p) { return p.seen.picture == state.picture; });
  };
  std::size_t first = 0;
  for (std::size_t g = 0; g < segment.groups.size(); ++g) {
    Segment::Group& group = segment.groups[g];
    for (Tools& t : tools) t.renderer.begin_group(g);
    std::vector<Result<PictureCost>> found(group.pictures);
    workers.run(static_cast<int>(group.pictures), [&](int k, int worker) {
      const std::size_t t = first + k;
      const auto source = segment.pictures.read(t);
      const State& state = segment.states[t];
      found[k] = source ? cost_of({pictures_[t], *source, state, is_pattern(state)}, tools[worker])
                        : fail(source.error());
    });
    std::vector<PictureCost> costs;
    for (auto& cost : found) {
      if (!cost) return fail(cost.error());
      costs.push_back(std::move(*cost));
    }
    auto planned = motion.add(costs, durations_[g]);
    if (!planned) return fail(planned.error());
    group.payload = std::move(planned->payload);
    for (const State& to : planned->states) segment.move(first++, to);
  }
  after_ = std::move(motion);
  return {};
}

void SegmentRefit::begin_segment(const MotionTrack& motion) {
  pictures_.clear();
  durations_.clear();
  before_ = motion;
  after_.reset();
}

}  // namespace fbs
