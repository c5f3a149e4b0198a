#include "encoder/blend/pattern_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "decoder/blend/mesh_blend.h"

namespace fbs {
namespace {

constexpr float kToOne = 1.0F / kMeshWeightOne;

/// The share of the texture in the samples of a run.
RunValue factor(const SourceRun& s, const RunValue& weight, bool luma) {
  const float share = (luma ? 1 + s.gain : 1) * (1 - s.opacity);
  return {share * weight.first, share * weight.step};
}

/// Whether the run shows its own samples, unmoved.
bool is_identity(const SourceRun& s, const SurfaceRun& run) {
  return s.u.step == 1 && s.v.step == 0 && s.u.first == static_cast<float>(run.first) &&
         s.v.first == static_cast<float>(run.row);
}

/// Calls use(i, sample number of the upper left one, fx, fy) for the four samples that each sample of a run
/// mixes.
template <class Use>
void for_each_footprint(const SourceRun& s, int count, const ReducedPlane& plane, Use&& use) {
  float u = s.u.first, v = s.v.first;
  const auto at = [&](int i, float x, float y) {
    const int column = std::min(static_cast<int>(x), plane.width - 2),
              row = std::min(static_cast<int>(y), plane.height - 2);
    use(i, static_cast<std::ptrdiff_t>(row) * plane.width + column, x - static_cast<float>(column),
        y - static_cast<float>(row));
  };
  if (is_inside(s, count, plane)) {
    for (int i = 0; i < count; ++i, u += s.u.step, v += s.v.step) at(i, u, v);
  } else {
    for (int i = 0; i < count; ++i, u += s.u.step, v += s.v.step)
      at(i, std::clamp(u, 0.0F, static_cast<float>(plane.width - 1)),
         std::clamp(v, 0.0F, static_cast<float>(plane.height - 1)));
  }
}

void clear(std::span<ReducedPlane> planes) {
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
  const SceneGeometry& geometry = scene_.geometry;
  const ScreenMesh mesh = geometry.screen_mesh(state);
  const VisibleSurface surface(geometry, mesh, size.x, size.y, reduction_);
  std::vector<const State*> seen;
  std::vector<const TextureMesh*> textures;
  for (const std::size_t k : available) {
    seen.push_back(&scene_.patterns[k].seen);
    textures.push_back(&scene_.patterns[k].texture);
  }
  const MeshBlend blend = blend_mesh(blend_picture(seen, state), geometry, textures);
  const PictureMesh picture{surface, mesh, scene_.mouth, reduction_};
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
                      run,
                      static_cast<std::uint32_t>(available[k])});
    }
  }
  taps.shrink_to_fit();
  pictures_.push_back(std::move(taps));
}

std::size_t PatternSolver::bytes() const {
  std::size_t taps = 0;
  for (const Taps& t : pictures_) taps += t.size();
  return taps * sizeof(Tap);
}

void PatternSolver::draw(const Taps& taps, const PatternPlanes& planes, bool luma, ReducedPlane& out) {
  for (const Tap& t : taps) {
    const ReducedPlane& plane = planes[t.pattern];
    const RunValue f = factor(t.source, t.weight, luma);
    float* to = out.row(t.run.row) + t.run.first;
    if (is_identity(t.source, t.run)) {
      const float* from = plane.row(t.run.row) + t.run.first;
      for (int i = 0; i < t.run.count; ++i) to[i] += (f.first + f.step * static_cast<float>(i)) * from[i];
      continue;
    }
    const float* samples = plane.samples.data();
    for_each_footprint(t.source, t.run.count, plane, [&](int i, std::ptrdiff_t at, float fx, float fy) {
      const float* a = samples + at;
      const float* b = a + plane.width;
      const float top = a[0] + fx * (a[1] - a[0]), bottom = b[0] + fx * (b[1] - b[0]);
      to[i] += (f.first + f.step * static_cast<float>(i)) * (top + fy * (bottom - top));
    });
  }
}

void PatternSolver::draw_transposed(const Taps& taps, const ReducedPlane& picture, bool luma,
                                    PatternPlanes& planes) {
  for (const Tap& t : taps) {
    ReducedPlane& plane = planes[t.pattern];
    const RunValue f = factor(t.source, t.weight, luma);
    const float* from = picture.row(t.run.row) + t.run.first;
    if (is_identity(t.source, t.run)) {
      float* to = plane.row(t.run.row) + t.run.first;
      for (int i = 0; i < t.run.count; ++i) to[i] += (f.first + f.step * static_cast<float>(i)) * from[i];
      continue;
    }
    float* samples = plane.samples.data();
    for_each_footprint(t.source, t.run.count, plane, [&](int i, std::ptrdiff_t at, float fx, float fy) {
      const float value = (f.first + f.step * static_cast<float>(i)) * from[i];
      float* a = samples + at;
      float* b = a + plane.width;
      const float bottom = value * fy, top = value - bottom, top_right = top * fx, bottom_right = bottom * fx;
      a[0] += top - top_right;
      a[1] += top_right;
      b[0] += bottom - bottom_right;
      b[1] += bottom_right;
    });
  }
}

void PatternSolver::draw_constant(const Taps& taps, std::size_t plane, ReducedPlane& out) {
  for (const Tap& t : taps) {
    const SourceRun& s = t.source;
    const RunValue light = plane == 0 ? s.offset : RunValue{};
    const float gain = plane == 0 ? s.gain : 0;
    float* to = out.row(t.run.row) + t.run.first;
    float weight = t.weight.first, offset = light.first;
    for (int i = 0; i < t.run.count; ++i, weight += t.weight.step, offset += light.step)
      to[i] += weight * ((1 - s.opacity) * (offset - 128.0F * gain) + s.opacity * s.interior[plane]);
  }
}

PatternPlanes PatternSolver::gradient(std::span<const ReducedPlane> targets, const PatternPlanes& planes,
                                      std::size_t plane) const {
  PatternPlanes out = planes;
  clear(out);
  ReducedPlane scratch = targets.front();
  for (std::size_t t = 0; t < pictures_.size(); ++t) {
    std::fill(scratch.samples.begin(), scratch.samples.end(), 0.0F);
    draw(pictures_[t], planes, plane == 0, scratch);
    draw_constant(pictures_[t], plane, scratch);
    for (std::size_t i = 0; i < scratch.samples.size(); ++i)
      scratch.samples[i] = targets[t].samples[i] - scratch.samples[i];
    draw_transposed(pictures_[t], scratch, plane == 0, out);
  }
  return out;
}

double PatternSolver::mean_weight(const PatternPlanes& planes) const {
  double used = 0;
  std::size_t samples = 0;
  for (const Taps& taps : pictures_)
    for (const Tap& t : taps) used += static_cast<double>(static_cast<float>(t.run.count) * t.weight.first);
  for (const ReducedPlane& p : planes) samples += p.samples.size();
  return used / static_cast<double>(samples);
}

PatternPlanes PatternSolver::solve(std::span<const ReducedPlane> targets, PatternPlanes sources,
                                   std::size_t count, std::size_t plane,
                                   const SolverSettings& settings) const {
  const bool luma = plane == 0;
  const auto hold_fixed = [&](PatternPlanes& planes) {
    clear(std::span(planes).first(planes.size() - count));
  };
  // The start is the anchor, so that the pull has no part in the first residual.
  PatternPlanes residual = gradient(targets, sources, plane), product = residual;
  hold_fixed(residual);
  const double pull = settings.pull * mean_weight(sources);
  ReducedPlane scratch = targets.front();
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
    hold_fixed(product);
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
