#include "encoder/blend/pattern_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "decoder/blend/mesh_blend.h"

namespace fbs {
namespace {

constexpr float kToOne = 1.0F / kMeshWeightOne;

/// The share of the texture in a sample.
float factor(const SourceRun& s, float weight, bool luma) {
  return luma ? weight * (1 + s.gain) * (1 - s.opacity) : weight * (1 - s.opacity);
}

/// The four samples that a texture position mixes.
struct Footprint {
  std::ptrdiff_t at;
  float fx, fy;
  Footprint(const ReducedPlane& plane, float u, float v) {
    u = std::clamp(u, 0.0F, static_cast<float>(plane.width - 1));
    v = std::clamp(v, 0.0F, static_cast<float>(plane.height - 1));
    const int x = std::min(static_cast<int>(u), plane.width - 2),
              y = std::min(static_cast<int>(v), plane.height - 2);
    at = static_cast<std::ptrdiff_t>(y) * plane.width + x;
    fx = u - static_cast<float>(x);
    fy = v - static_cast<float>(y);
  }
};

void clear(PatternPlanes& planes) {
  for (ReducedPlane& p : planes) std::fill(p.samples.begin(), p.samples.end(), 0.0F);
}

double dot(const PatternPlanes& a, const PatternPlanes& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    float part = 0;
    for (std::size_t i = 0; i < a[k].samples.size(); ++i) part += a[k].samples[i] * b[k].samples[i];
    sum += static_cast<double>(part);
  }
  return sum;
}

/// a += factor * b
void add(PatternPlanes& a, double factor, const PatternPlanes& b) {
  const auto f = static_cast<float>(factor);
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].samples.size(); ++i) a[k].samples[i] += f * b[k].samples[i];
}

}  // namespace

void PatternSolver::add_picture(const State& state, std::span<const std::size_t> available, glm::ivec2 size) {
  const SceneGeometry& geometry = *scene_.geometry;
  const ScreenMesh mesh = geometry.screen_mesh(state);
  const VisibleSurface surface(geometry, mesh, size.x, size.y, reduction_);
  std::vector<const State*> seen;
  std::vector<const TextureMesh*> textures;
  for (const std::size_t k : available) {
    seen.push_back(&scene_.patterns[k].seen);
    textures.push_back(&scene_.patterns[k].texture);
  }
  const MeshBlend blend = blend_mesh(blend_picture(seen, state), geometry, textures);
  const PictureMesh picture{surface, mesh, scene_.setup.mouth, reduction_};
  Taps taps;
  for (const SurfaceRun& run : surface.runs()) {
    const SurfaceTriangle& t = surface.triangles()[run.triangle];
    const PointWeights& weights = t.head ? blend.head : blend.surround;
    const auto w0 = weights.at(t.corners[0]), w1 = weights.at(t.corners[1]), w2 = weights.at(t.corners[2]);
    const Barycentric& b = surface.barycentric(run.triangle);
    const glm::vec2 at = b.at(static_cast<float>(run.first), static_cast<float>(run.row));
    for (std::size_t s = 0; s < weights.sources; ++s) {
      if ((w0[s] | w1[s] | w2[s]) == 0) continue;
      const glm::vec2 d = glm::vec2(w1[s] - w0[s], w2[s] - w0[s]) * kToOne;
      const std::size_t k = blend.sources[s].pattern;
      taps.push_back({source_run(picture, run, *textures[k], blend.sources[s].still),
                      {static_cast<float>(w0[s]) * kToOne + glm::dot(at, d), glm::dot(b.per_column, d)},
                      run.row,
                      run.first,
                      run.count,
                      static_cast<std::uint32_t>(available[k])});
    }
  }
  pictures_.push_back(std::move(taps));
}

void PatternSolver::draw(const Taps& taps, const PatternPlanes& planes, bool luma, ReducedPlane& out) const {
  for (const Tap& t : taps) {
    const ReducedPlane& plane = planes[t.pattern];
    float* to = out.row(t.row) + t.first;
    float u = t.source.u.first, v = t.source.v.first, weight = t.weight.first;
    for (int i = 0; i < t.count; ++i, u += t.source.u.step, v += t.source.v.step, weight += t.weight.step)
      to[i] += factor(t.source, weight, luma) * bilinear(plane, u, v);
  }
}

void PatternSolver::draw_transposed(const Taps& taps, const ReducedPlane& picture, bool luma,
                                    PatternPlanes& planes) const {
  for (const Tap& t : taps) {
    ReducedPlane& plane = planes[t.pattern];
    const float* from = picture.row(t.row) + t.first;
    float u = t.source.u.first, v = t.source.v.first, weight = t.weight.first;
    for (int i = 0; i < t.count; ++i, u += t.source.u.step, v += t.source.v.step, weight += t.weight.step) {
      const Footprint f(plane, u, v);
      const float value = factor(t.source, weight, luma) * from[i];
      float* a = plane.samples.data() + f.at;
      float* b = a + plane.width;
      const float top = value * (1 - f.fy), bottom = value * f.fy;
      a[0] += top * (1 - f.fx);
      a[1] += top * f.fx;
      b[0] += bottom * (1 - f.fx);
      b[1] += bottom * f.fx;
    }
  }
}

void PatternSolver::draw_constant(const Taps& taps, ReducedPlane& out) const {
  for (const Tap& t : taps) {
    float* to = out.row(t.row) + t.first;
    float weight = t.weight.first, offset = t.source.offset.first;
    for (int i = 0; i < t.count; ++i, weight += t.weight.step, offset += t.source.offset.step)
      to[i] += weight * ((1 - t.source.opacity) * (offset - 128.0F * t.source.gain) +
                         t.source.opacity * t.source.interior);
  }
}

PatternPlanes PatternSolver::solve(std::span<const ReducedPlane> targets, PatternPlanes sources, bool luma,
                                   const SolverSettings& settings) const {
  ReducedPlane scratch = targets.front();
  PatternPlanes weight = sources, residual = sources, product = sources;
  clear(weight);
  clear(residual);
  // Residual of the start, and how much each sample of a pattern is used.
  for (std::size_t t = 0; t < pictures_.size(); ++t) {
    std::fill(scratch.samples.begin(), scratch.samples.end(), 0.0F);
    draw(pictures_[t], sources, luma, scratch);
    if (luma) draw_constant(pictures_[t], scratch);
    for (std::size_t i = 0; i < scratch.samples.size(); ++i)
      scratch.samples[i] = targets[t].samples[i] - scratch.samples[i];
    draw_transposed(pictures_[t], scratch, luma, residual);
  }
  // The start is the anchor, so that the pull has no part in the first residual.
  double used = 0;
  std::size_t samples = 0;
  for (const Taps& taps : pictures_)
    for (const Tap& t : taps) used += static_cast<double>(t.count * t.weight.first);
  for (const ReducedPlane& p : sources) samples += p.samples.size();
  const double pull = settings.pull * used / static_cast<double>(samples);

  PatternPlanes x = std::move(sources), direction = residual;
  double now = dot(residual, residual);
  const double begin = now;
  for (int i = 0; i < settings.iterations && now > 1e-4 * begin; ++i) {
    clear(product);
    for (const Taps& taps : pictures_) {
      std::fill(scratch.samples.begin(), scratch.samples.end(), 0.0F);
      draw(taps, direction, luma, scratch);
      draw_transposed(taps, scratch, luma, product);
    }
    add(product, pull, direction);
    const double step = now / dot(direction, product);
    add(x, step, direction);
    add(residual, -step, product);
    const double next = dot(residual, residual);
    for (std::size_t k = 0; k < direction.size(); ++k)
      for (std::size_t s = 0; s < direction[k].samples.size(); ++s)
        direction[k].samples[s] =
            residual[k].samples[s] + static_cast<float>(next / now) * direction[k].samples[s];
    now = next;
  }
  return x;
}

}  // namespace fbs
