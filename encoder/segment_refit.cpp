#include "encoder/segment_refit.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "bitstream/track.h"
#include "decoder/blend/picture_blend.h"
#include "decoder/head/head_deformation.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/mouth_interior.h"
#include "decoder/renderer.h"

namespace fbs {
namespace {

constexpr int kFirstSurround = first_of(PartId::kBody);
const cv::Range kSurroundNumbers(kFirstSurround, kFirstSurround + 2 * kSimilarityCount);

/// Draws the pictures of a segment as the decoder will.
class SegmentRenderer {
 public:
  SegmentRenderer(const SegmentPatterns& patterns, const Setup& setup) : patterns_(patterns) {
    scene_.setup = setup;
    scene_.geometry = patterns.scene.geometry;
    for (const Pattern& p : patterns.scene.patterns)
      gaps_.push_back(mouth_gap(deform(patterns.scene.geometry.geometry().positions, p.seen)));
  }

  void begin_group(std::size_t group) {
    const AvailablePatterns& wanted = patterns_.available[group];
    scene_.patterns.resize(wanted.size());
    slots_.resize(wanted.size(), patterns_.scene.patterns.size());
    for (std::size_t slot = 0; slot < wanted.size(); ++slot)
      if (slots_[slot] != wanted[slot]) scene_.patterns[slot] = patterns_.scene.patterns[wanted[slot]];
    slots_ = wanted;
  }

  [[nodiscard]] Result<Picture> draw(const State& state) {
    Picture out;
    if (auto drawn = renderer_.render(scene_, state, out); !drawn) return fail(drawn.error());
    return out;
  }

  /// Mean over what the mouth is blended from, 0..1.
  [[nodiscard]] double interior_opacity(const State& state) const {
    std::vector<const State*> seen;
    for (const Pattern& p : scene_.patterns) seen.push_back(&p.seen);
    const std::int32_t gap = mouth_gap(deform(scene_.geometry->geometry().positions, state));
    double sum = 0;
    const PictureBlend blend = blend_picture(seen, state);
    for (const WeightedSource& s : blend[static_cast<std::size_t>(Region::kMouth)])
      if (!s.source.still) sum += s.weight * fbs::interior_opacity(gap, gaps_[slots_[s.source.pattern]]);
    return sum / (double{kBlendOne} * kInteriorOpaque);
  }

 private:
  const SegmentPatterns& patterns_;
  Scene scene_;
  AvailablePatterns slots_;         ///< pattern in each of the scene's
  std::vector<std::int32_t> gaps_;  ///< mouth_gap() of each pattern
  Renderer renderer_;
};

WorkFrame frame_of(const Picture& picture, glm::dvec2 centre, double eye_distance_px) {
  return WorkFrame::cut(picture, centre, eye_distance_px, false);
}

double box_error(const Picture& a, const Picture& b, const std::array<glm::ivec3, kVertexCount>& v) {
  int x0 = 1 << 30, x1 = 0, y0 = 1 << 30, y1 = 0;
  for (const auto& p : v) {
    x0 = std::min(x0, p.x / 64), x1 = std::max(x1, p.x / 64);
    y0 = std::min(y0, p.y / 64), y1 = std::max(y1, p.y / 64);
  }
  x0 = std::max(x0, 0), y0 = std::max(y0, 0), x1 = std::min(x1, a.width() - 1),
  y1 = std::min(y1, a.height() - 1);
  double sum = 0;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const int d = a.y.row(y)[x] - b.y.row(y)[x];
      sum += d * d;
    }
  return sum / ((x1 - x0 + 1) * (y1 - y0 + 1));
}

}  // namespace

SegmentRefit::SegmentRefit(const Setup& setup, const Geometry& geometry, const Pattern& first,
                           double eye_distance_px)
    : eye_distance_px_(eye_distance_px),
      fit_(setup, geometry,
           {frame_of(first.picture, pose_of(first.seen).shift, eye_distance_px), first.seen}) {}

void SegmentRefit::add(const FaceAnalysis::Observation& picture, std::uint32_t duration) {
  Fitted f{picture.fit, picture.seen, duration, {}, {}};
  std::copy_n(picture.cost.fit.begin() + kFirstSurround, f.surround.size(), f.surround.begin());
  for (const LayerCost& layer : picture.cost.layers)
    if (layer.layer == CostLayer::kSurround)
      f.surround_cost = layer.quadratic(kSurroundNumbers, kSurroundNumbers).clone();
  pictures_.push_back(std::move(f));
}

PictureCost SegmentRefit::cost_of(const Fitted& fitted, const Picture& source, const Picture& drawn,
                                  const State& state, double interior_opacity, const MouthInterior& mouth) {
  PictureCost cost;
  if (fitted.seen) {
    const glm::dvec2 centre = fitted.fit.pose.shift;
    const WorkFrame pattern = frame_of(drawn, centre, eye_distance_px_);
    fit_.set_pattern({pattern, state, 0, interior_opacity});
    fit_.set_picture(frame_of(source, centre, eye_distance_px_), mouth);
    static const char* const mode = std::getenv("REFIT_START");
    Fit start = fitted.fit;
    if (mode && mode[0] == 's') start = fit_of(state);
    const Fit best = mode && mode[0] == 'k' ? start : fit_.refine(start);
    last_fits_.push_back(state_of(best));
    cost = fit_.cost_at(best);
  } else {
    cost = cost_unseen(fitted.fit);
    last_fits_.push_back(state_of(fitted.fit));
  }
  if (!fitted.surround_cost.empty()) {
    LayerCost layer{CostLayer::kSurround, 0, 0, cv::Mat1d::zeros(kParameterCount, kParameterCount)};
    fitted.surround_cost.copyTo(layer.quadratic(kSurroundNumbers, kSurroundNumbers));
    cost.layers.push_back(std::move(layer));
    std::copy(fitted.surround.begin(), fitted.surround.end(), cost.fit.begin() + kFirstSurround);
  }
  return cost;
}

Result<void> SegmentRefit::run(Segment& segment, const SegmentPatterns& patterns, const Setup& setup,
                               MotionTrack& motion) {
  SegmentRenderer renderer(patterns, setup);
  std::size_t t = 0;
  std::vector<State> states;
  last_fits_.clear();
  std::size_t before = 0, after = 0;
  for (std::size_t g = 0; g < segment.groups.size(); ++g) {
    Segment::Group& group = segment.groups[g];
    renderer.begin_group(g);
    std::vector<PictureCost> costs;
    std::vector<std::uint32_t> durations;
    for (const std::size_t end = t + group.pictures; t < end; ++t) {
      const State& state = segment.states[t];
      auto source = segment.pictures.read(t);
      if (!source) return fail(source.error());
      auto drawn = renderer.draw(state);
      if (!drawn) return fail(drawn.error());
      costs.push_back(cost_of(pictures_[t], *source, *drawn, state, renderer.interior_opacity(state),
                              setup.mouth));
      static const double weight = std::getenv("REFIT_K") ? std::atof(std::getenv("REFIT_K")) : 1;
      for (const Pattern& p : patterns.scene.patterns)
        if (p.seen.picture == state.picture) {
          costs.back().layers[0] = fit_.cost_at(fit_of(state)).layers[0];
          const auto now = fit_.cost_at(fit_of(state)).fit;
          std::copy_n(now.begin(), kFirstSurround, costs.back().fit.begin());
          std::copy(now.begin() + kFirstSurround + 8, now.end(),
                    costs.back().fit.begin() + kFirstSurround + 8);
          for (LayerCost& layer : costs.back().layers) layer.quadratic *= weight;
        }
      durations.push_back(pictures_[t].duration);
    }
    auto planned = motion.add(costs, durations);
    if (!planned) return fail(planned.error());
    if (std::getenv("REFIT_LOG")) {
      static double sum[5];
      static int n;
      for (std::size_t i = 0; i < group.pictures; ++i) {
        const std::size_t k = t - group.pictures + i;
        State state[4] = {segment.states[k], state_of(pictures_[k].fit), last_fits_[k], planned->states[i]};
        auto source = segment.pictures.read(k);
        const auto v = project_vertices(patterns.scene.geometry.geometry().positions, state[0]);
        for (int j = 0; j < 4; ++j) {
          if (j == 1 || j == 2) state[j].body = state[0].body, state[j].ground = state[0].ground;
          state[j].picture = state[0].picture;
          state[j].blend = state[0].blend;
          sum[j] += box_error(*renderer.draw(state[j]), *source, v);
        }
        ++n;
      }
      if (g + 1 == segment.groups.size()) {
        std::fprintf(stderr, "face box: s0 %.2f f0 %.2f f1 %.2f s1 %.2f\n", sum[0] / n, sum[1] / n,
                     sum[2] / n, sum[3] / n);
        n = 0;
        std::fill(sum, sum + 5, 0.0);
      }
    }
    before += group.payload.size();
    after += planned->payload.size();
    group.payload = std::move(planned->payload);
    for (State& s : planned->states) {
      s.picture = segment.states[states.size()].picture;
      s.blend = segment.states[states.size()].blend;
      states.push_back(s);
    }
  }
  if (std::getenv("REFIT_LOG")) std::fprintf(stderr, "motion %zu -> %zu\n", before, after);
  segment.states = std::move(states);
  return {};
}

}  // namespace fbs
