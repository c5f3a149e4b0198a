#include "encoder/blend/pattern_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "decoder/blend/mesh_blend.h"

namespace fbs {
namespace {

/// A lane has converged when its squared residual has fallen to this share.
constexpr double kConverged = 1e-4;

constexpr float kToOne = 1.0F / kMeshWeightOne;

void clear(std::span<SolvedPlanes> planes) {
  for (SolvedPlanes& p : planes) std::fill(p.samples.begin(), p.samples.end(), glm::vec4(0));
}

/// Inner product per lane.
glm::dvec4 dot(const PatternPlanes& a, const PatternPlanes& b) {
  glm::dvec4 sum(0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    glm::vec4 part(0);
    for (std::size_t i = 0; i < a[k].samples.size(); ++i) part += a[k].samples[i] * b[k].samples[i];
    sum += glm::dvec4(part);
  }
  return sum;
}

/// a += factor * b
void add(PatternPlanes& a, const glm::dvec4& factor, const PatternPlanes& b) {
  const glm::vec4 f(factor);
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].samples.size(); ++i) a[k].samples[i] += f * b[k].samples[i];
}

/// a = b + factor * a
void scale_and_add(PatternPlanes& a, const glm::dvec4& factor, const PatternPlanes& b) {
  const glm::vec4 f(factor);
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].samples.size(); ++i)
      a[k].samples[i] = b[k].samples[i] + f * a[k].samples[i];
}

/// Zero for converged lanes.
glm::dvec4 ratio(const glm::dvec4& a, const glm::dvec4& b, const glm::bvec4& done) {
  return glm::mix(a / glm::mix(b, glm::dvec4(1), done), glm::dvec4(0), done);
}

}  // namespace

SolvedPlanes::SolvedPlanes(std::span<const ReducedPlane> planes)
    : width(planes.front().width), height(planes.front().height), samples(planes.front().samples.size()) {
  for (std::size_t lane = 0; lane < planes.size(); ++lane)
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i][static_cast<int>(lane)] = planes[lane].samples[i];
}

ReducedPlane SolvedPlanes::plane(int lane) const {
  ReducedPlane out{width, height, std::vector<float>(samples.size())};
  for (std::size_t i = 0; i < samples.size(); ++i) out.samples[i] = samples[i][lane];
  return out;
}

PatternSolver::PatternSolver(const BlendScene& scene, int reduction, std::vector<std::size_t> planes)
    : scene_(scene), reduction_(reduction), planes_(std::move(planes)) {
  for (std::size_t lane = 0; lane < planes_.size(); ++lane) {
    is_used_[static_cast<int>(lane)] = 1;
    if (planes_[lane] == 0) is_luma_[static_cast<int>(lane)] = 1;
  }
}

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
  const MeshBlend blend = blend_mesh(blend_picture(seen, state), geometry, textures, mesh);
  const PointWeights surround = point_weights(blend.regions, geometry.surround().shares());
  const PictureMesh picture{surface, mesh, scene_.mouth, reduction_};
  Taps taps;
  for (const SurfaceRun& run : surface.runs()) {
    const SurfaceTriangle& t = surface.triangles()[run.triangle];
    const PointWeights& weights = t.head ? blend.head : surround;
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

std::pair<glm::vec4, glm::vec4> PatternSolver::factor(const Tap& tap) const {
  const glm::vec4 share = (is_used_ + tap.source.gain * is_luma_) * (1 - tap.source.opacity);
  return {share * tap.weight.first, share * tap.weight.step};
}

void PatternSolver::draw(const Taps& taps, const PatternPlanes& planes, SolvedPlanes& out) const {
  for (const Tap& t : taps) {
    const SolvedPlanes& plane = planes[t.pattern];
    auto [f, f_step] = factor(t);
    glm::vec4* to = out.row(t.run.row) + t.run.first;
    if (is_identity(t.source, t.run)) {
      const glm::vec4* from = plane.row(t.run.row) + t.run.first;
      for (int i = 0; i < t.run.count; ++i, f += f_step) to[i] += f * from[i];
      continue;
    }
    const glm::vec4* samples = plane.samples.data();
    for_each_footprint(t.source, t.run.count, {plane.width, plane.height},
                       [&, f = f, f_step = f_step](int i, int at, float fx, float fy) mutable {
                         const glm::vec4* a = samples + at;
                         const glm::vec4* b = a + plane.width;
                         const glm::vec4 top = a[0] + fx * (a[1] - a[0]), bottom = b[0] + fx * (b[1] - b[0]);
                         to[i] += f * (top + fy * (bottom - top));
                         f += f_step;
                       });
  }
}

void PatternSolver::draw_transposed(const Taps& taps, const SolvedPlanes& picture,
                                    PatternPlanes& planes) const {
  for (const Tap& t : taps) {
    SolvedPlanes& plane = planes[t.pattern];
    auto [f, f_step] = factor(t);
    const glm::vec4* from = picture.row(t.run.row) + t.run.first;
    if (is_identity(t.source, t.run)) {
      glm::vec4* to = plane.row(t.run.row) + t.run.first;
      for (int i = 0; i < t.run.count; ++i, f += f_step) to[i] += f * from[i];
      continue;
    }
    glm::vec4* samples = plane.samples.data();
    for_each_footprint(t.source, t.run.count, {plane.width, plane.height},
                       [&, f = f, f_step = f_step](int i, int at, float fx, float fy) mutable {
                         const glm::vec4 value = f * from[i];
                         f += f_step;
                         glm::vec4* a = samples + at;
                         glm::vec4* b = a + plane.width;
                         const glm::vec4 bottom = value * fy, top = value - bottom, top_right = top * fx,
                                         bottom_right = bottom * fx;
                         a[0] += top - top_right;
                         a[1] += top_right;
                         b[0] += bottom - bottom_right;
                         b[1] += bottom_right;
                       });
  }
}

void PatternSolver::draw_constant(const Taps& taps, SolvedPlanes& out) const {
  for (const Tap& t : taps) {
    const SourceRun& s = t.source;
    glm::vec4 first(0), step(0);
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const auto lane = static_cast<int>(k);
      first[lane] = s.opacity * s.interior[planes_[k]];
      if (planes_[k] != 0) continue;
      first[lane] += (1 - s.opacity) * (s.offset.first - 128.0F * s.gain);
      step[lane] = (1 - s.opacity) * s.offset.step;
    }
    glm::vec4* to = out.row(t.run.row) + t.run.first;
    float weight = t.weight.first;
    for (int i = 0; i < t.run.count; ++i, weight += t.weight.step, first += step) to[i] += weight * first;
  }
}

PatternPlanes PatternSolver::gradient(std::span<const SolvedPlanes> targets,
                                      const PatternPlanes& planes) const {
  PatternPlanes out = planes;
  clear(out);
  SolvedPlanes scratch = targets.front();
  for (std::size_t t = 0; t < pictures_.size(); ++t) {
    clear({&scratch, 1});
    draw(pictures_[t], planes, scratch);
    draw_constant(pictures_[t], scratch);
    for (std::size_t i = 0; i < scratch.samples.size(); ++i)
      scratch.samples[i] = targets[t].samples[i] - scratch.samples[i];
    draw_transposed(pictures_[t], scratch, out);
  }
  return out;
}

double PatternSolver::mean_weight(const PatternPlanes& planes) const {
  double used = 0;
  std::size_t samples = 0;
  for (const Taps& taps : pictures_)
    for (const Tap& t : taps) used += static_cast<double>(static_cast<float>(t.run.count) * t.weight.first);
  for (const SolvedPlanes& p : planes) samples += p.samples.size();
  return used / static_cast<double>(samples);
}

PatternPlanes PatternSolver::solve(std::span<const SolvedPlanes> targets, PatternPlanes sources,
                                   std::size_t count, const SolverSettings& settings) const {
  const auto hold_fixed = [&](PatternPlanes& planes) {
    clear(std::span(planes).first(planes.size() - count));
  };
  // Starts at the anchor, so that the pull has no part in the first residual.
  PatternPlanes residual = gradient(targets, sources), product = residual;
  hold_fixed(residual);
  const glm::dvec4 pull(settings.pull * mean_weight(sources));
  SolvedPlanes scratch = targets.front();
  PatternPlanes x = std::move(sources), direction = residual;
  // The planes are separate problems: each lane has its own steps.
  glm::dvec4 now = dot(residual, residual);
  const glm::dvec4 enough = kConverged * now;
  for (int i = 0; i < settings.iterations; ++i) {
    const glm::bvec4 done = glm::lessThanEqual(now, enough);
    if (glm::all(done)) break;
    clear(product);
    for (const Taps& taps : pictures_) {
      clear({&scratch, 1});
      draw(taps, direction, scratch);
      draw_transposed(taps, scratch, product);
    }
    hold_fixed(product);
    add(product, pull, direction);
    const glm::dvec4 step = ratio(now, dot(direction, product), done);
    add(x, step, direction);
    add(residual, -step, product);
    const glm::dvec4 next = dot(residual, residual);
    scale_and_add(direction, ratio(next, now, done), residual);
    now = next;
  }
  return x;
}

}  // namespace fbs
