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

std::array<std::int32_t, 8> surround_of(const State& s) {
  return {s.body[0], s.body[1], s.body[2], s.body[3], s.ground[0], s.ground[1], s.ground[2], s.ground[3]};
}
void set_surround(State& s, const std::array<std::int32_t, 8>& v) {
  for (int i = 0; i < 4; ++i) s.body[i] = v[i], s.ground[i] = v[4 + i];
}

double frame_error(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.y.samples.size(); ++i) {
    const int d = a.y.samples[i] - b.y.samples[i];
    sum += d * d;
  }
  return sum / static_cast<double>(a.y.samples.size());
}

/// Quadratic and target of body and ground, by drawing.
void refit_surround(SegmentRenderer& renderer, const State& state, const Picture& source,
                    const Picture& drawn, cv::Mat1d& quadratic, std::array<double, 8>& target) {
  constexpr int kStep = 64;
  static const double prior_sigma = std::getenv("REFIT_SP") ? std::atof(std::getenv("REFIT_SP")) : 64;
  std::array<Picture, 8> up;
  for (int i = 0; i < 8; ++i) {
    State s = state;
    auto v = surround_of(s);
    v[i] += kStep;
    set_surround(s, v);
    up[i] = *renderer.draw(s);
    v[i] -= 2 * kStep;
    set_surround(s, v);
    const Picture down = *renderer.draw(s);
    // As up - down + 128, halved.
    for (std::size_t k = 0; k < down.y.samples.size(); ++k)
      up[i].y.samples[k] = static_cast<std::uint8_t>((up[i].y.samples[k] - down.y.samples[k] + 256) / 2);
  }
  cv::Mat1d q = cv::Mat1d::zeros(8, 8), r = cv::Mat1d::zeros(8, 1), left;
  for (std::size_t k = 0; k < drawn.y.samples.size(); ++k) {
    double row[8];
    bool any = false;
    for (int i = 0; i < 8; ++i) {
      row[i] = (up[i].y.samples[k] - 128) / double{kStep};
      any = any || row[i] != 0;
    }
    if (!any) continue;
    const double e = source.y.samples[k] - drawn.y.samples[k];
    const double w = 1 / ((1 + e * e / 1024) * (1 + e * e / 1024));
    for (int i = 0; i < 8; ++i) {
      r(i) += w * row[i] * e;
      for (int j = 0; j < 8; ++j) q(i, j) += w * row[i] * row[j];
    }
  }
  left = q.clone();
  for (int i = 0; i < 8; ++i) left(i, i) += 2000 / (prior_sigma * prior_sigma);
  cv::Mat1d x;
  cv::solve(left, r, x, cv::DECOMP_CHOLESKY);
  quadratic = q;
  const auto now = surround_of(state);
  for (int i = 0; i < 8; ++i) target[i] = now[i] + x(i);
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
    static const bool one = std::getenv("REFIT_ONE");
    if (one) {
      PictureFit::Refined r = fit_.refined_cost(start);
      last_fits_.push_back(state_of(r.fit));
      cost = std::move(r.cost);
    } else {
    const Fit best = mode && mode[0] == 'k' ? start : fit_.refine(start);
    last_fits_.push_back(state_of(best));
    cost = fit_.cost_at(best);
    }
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
      static const bool surround = std::getenv("REFIT_SURROUND");
      if (surround) {
        Fitted& f = pictures_[t];
        const auto old = f.surround;
        refit_surround(renderer, state, *source, *drawn, f.surround_cost, f.surround);
        State was = state, now = state;
        std::array<std::int32_t, 8> v;
        for (int i = 0; i < 8; ++i) v[i] = static_cast<int>(std::lround(old[i]));
        set_surround(was, v);
        for (int i = 0; i < 8; ++i) v[i] = static_cast<int>(std::lround(f.surround[i]));
        set_surround(now, v);
        frame_[0] += frame_error(*drawn, *source);
        frame_[1] += frame_error(*renderer.draw(was), *source);
        frame_[2] += frame_error(*renderer.draw(now), *source);
      }
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
      static const bool guard = std::getenv("REFIT_GUARD");
      if (guard && pictures_[t].seen) {
        State now = last_fits_[t];
        now.body = state.body, now.ground = state.ground;
        now.picture = state.picture, now.blend = state.blend;
        const auto v = project_vertices(patterns.scene.geometry.geometry().positions, state);
        if (box_error(*renderer.draw(now), *source, v) > box_error(*drawn, *source, v)) {
          last_fits_[t] = state;
          const PictureCost here = fit_.cost_at(fit_of(state));
          costs.back().layers[0] = here.layers[0];
          std::copy_n(here.fit.begin(), kFirstSurround, costs.back().fit.begin());
          std::copy(here.fit.begin() + kFirstSurround + 8, here.fit.end(),
                    costs.back().fit.begin() + kFirstSurround + 8);
        }
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
          if (j == 3) frame_[3] += frame_error(*renderer.draw(state[j]), *source);
          sum[j] += box_error(*renderer.draw(state[j]), *source, v);
        }
        ++n;
      }
      if (g + 1 == segment.groups.size()) {
        std::fprintf(stderr, "face box: s0 %.2f f0 %.2f f1 %.2f s1 %.2f\n", sum[0] / n, sum[1] / n,
                     sum[2] / n, sum[3] / n);
        std::fprintf(stderr, "frame: s0 %.2f f0 %.2f f1 %.2f s1 %.2f\n", frame_[0] / n, frame_[1] / n,
                     frame_[2] / n, frame_[3] / n);
        frame_ = {};
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
