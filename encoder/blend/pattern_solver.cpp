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

// Scales of the numbers of a tap.
constexpr float kPlaceOne = 64, kStepOne = 4096, kWeightOne = 16384;

std::int16_t fixed(float value, float one) {
  constexpr float kMost = 32767;
  return static_cast<std::int16_t>(std::lrint(std::clamp(value * one, -kMost, kMost)));
}

/// Pictures in memory at a time. They share the patterns near them in time, each of which is one worker's.
constexpr std::size_t kTogether = 16;

void clear(SolvedPlanes& planes) {
  std::fill(planes.samples.begin(), planes.samples.end(), glm::vec4(0));
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
    : scene_(scene), reduction_(reduction), inset_(border_inset(reduction)), planes_(std::move(planes)) {
  for (std::size_t lane = 0; lane < planes_.size(); ++lane) {
    is_used_[static_cast<int>(lane)] = 1;
    if (planes_[lane] == 0) is_luma_[static_cast<int>(lane)] = 1;
  }
}

void PatternSolver::set_picture(std::size_t number, const State& state,
                                std::span<const std::size_t> available, glm::ivec2 size) {
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
  struct Found {
    std::vector<Tap> taps;
    std::vector<Lit> lit;
  };
  std::vector<Found> by_pattern(scene_.patterns.size());
  for (const SurfaceRun& run : surface.runs()) {
    const SurfaceTriangle& t = surface.triangles()[run.triangle];
    const PointWeights& weights = t.head ? blend.head : surround;
    const auto w0 = weights.at(t.corners[0]), w1 = weights.at(t.corners[1]), w2 = weights.at(t.corners[2]);
    const Barycentric& b = surface.barycentric(run.triangle);
    const auto first = static_cast<float>(run.first), row = static_cast<float>(run.row);
    const glm::vec2 at = b.at(first, row);
    for (std::size_t s = 0; s < weights.sources; ++s) {
      if ((w0[s] | w1[s] | w2[s]) == 0) continue;
      const glm::vec2 d = glm::vec2(w1[s] - w0[s], w2[s] - w0[s]) * kToOne;
      const std::size_t k = blend.sources[s].pattern;
      const SourceRun source = source_run(picture, run, *textures[k], blend.sources[s].still);
      const bool is_lit =
          source.gain != 0 || source.opacity != 0 || source.offset.first != 0 || source.offset.step != 0;
      Found& found = by_pattern[available[k]];
      if (is_lit) found.lit.push_back({source.offset, source.gain, source.opacity, source.interior});
      found.taps.push_back({static_cast<std::uint16_t>(run.row), static_cast<std::uint16_t>(run.first),
                            static_cast<std::uint16_t>(run.count), t.head, is_identity(source, run), is_lit,
                            fixed(source.u.first - first, kPlaceOne), fixed(source.v.first - row, kPlaceOne),
                            fixed(source.u.step, kStepOne), fixed(source.v.step, kStepOne),
                            fixed(static_cast<float>(w0[s]) * kToOne + glm::dot(at, d), kWeightOne),
                            fixed(glm::dot(b.per_column, d), kWeightOne)});
    }
  }
  Taps taps;
  std::size_t count = 0, lit = 0;
  for (const Found& found : by_pattern) count += found.taps.size(), lit += found.lit.size();
  taps.all.reserve(count);
  taps.lit.reserve(lit);
  for (std::size_t k = 0; k < by_pattern.size(); ++k) {
    const Found& found = by_pattern[k];
    if (found.taps.empty()) continue;
    const std::size_t first_lit = taps.lit.size();
    taps.all.insert(taps.all.end(), found.taps.begin(), found.taps.end());
    taps.lit.insert(taps.lit.end(), found.lit.begin(), found.lit.end());
    taps.patterns.push_back({k, taps.all.size(), first_lit});
  }
  pictures_[number] = std::move(taps);
}

TexturePath PatternSolver::Tap::path(float surround_inset) const {
  return {
      {static_cast<float>(first) + static_cast<float>(by_u) / kPlaceOne,
       static_cast<float>(step_u) / kStepOne},
      {static_cast<float>(row) + static_cast<float>(by_v) / kPlaceOne, static_cast<float>(step_v) / kStepOne},
      head ? 0 : surround_inset};
}

RunValue PatternSolver::Tap::weights() const {
  return {static_cast<float>(weight) / kWeightOne, static_cast<float>(weight_step) / kWeightOne};
}

template <class Use>
void PatternSolver::for_each_tap(const Taps& taps, std::size_t place, Use&& use) {
  const Lit* lit = taps.lit.data() + taps.patterns[place].first_lit;
  for (std::size_t k = place > 0 ? taps.patterns[place - 1].end : 0; k < taps.patterns[place].end; ++k) {
    const Tap& tap = taps.all[k];
    use(tap, tap.lit ? lit++ : nullptr);
  }
}

std::size_t PatternSolver::bytes() const {
  std::size_t bytes = 0;
  for (const Taps& t : pictures_) bytes += t.all.size() * sizeof(Tap) + t.lit.size() * sizeof(Lit);
  return bytes;
}

void PatternSolver::draw(const Taps& taps, const Shown& planes, SolvedPlanes& out) const {
  for (std::size_t place = 0; place < taps.patterns.size(); ++place) {
    if (planes[taps.patterns[place].pattern] == nullptr) continue;
    const SolvedPlanes& plane = *planes[taps.patterns[place].pattern];
    for_each_tap(taps, place, [&](const Tap& t, const Lit* lit) {
      const glm::vec4 texture = share(t, lit);
      const RunValue weight = t.weights();
      const glm::vec4 f_step = texture * weight.step;
      glm::vec4 f = texture * weight.first;
      glm::vec4* to = out.row(t.row) + t.first;
      if (t.unmoved) {
        const glm::vec4* from = plane.row(t.row) + t.first;
        for (int i = 0; i < t.count; ++i, f += f_step) to[i] += f * from[i];
        return;
      }
      const glm::vec4* samples = plane.samples.data();
      for_each_footprint(
          t.path(inset_), t.count, {plane.width, plane.height}, [&](int i, int at, float fx, float fy) {
            const glm::vec4* a = samples + at;
            const glm::vec4* b = a + plane.width;
            const glm::vec4 top = a[0] + fx * (a[1] - a[0]), bottom = b[0] + fx * (b[1] - b[0]);
            to[i] += f * (top + fy * (bottom - top));
            f += f_step;
          });
    });
  }
}

void PatternSolver::draw_transposed(const Taps& taps, std::size_t pattern, const SolvedPlanes& picture,
                                    SolvedPlanes& plane) const {
  for (std::size_t place = 0; place < taps.patterns.size(); ++place) {
    if (taps.patterns[place].pattern != pattern) continue;
    for_each_tap(taps, place, [&](const Tap& t, const Lit* lit) {
      const glm::vec4 texture = share(t, lit);
      const RunValue weight = t.weights();
      const glm::vec4 f_step = texture * weight.step;
      glm::vec4 f = texture * weight.first;
      const glm::vec4* from = picture.row(t.row) + t.first;
      if (t.unmoved) {
        glm::vec4* to = plane.row(t.row) + t.first;
        for (int i = 0; i < t.count; ++i, f += f_step) to[i] += f * from[i];
        return;
      }
      glm::vec4* samples = plane.samples.data();
      for_each_footprint(t.path(inset_), t.count, {plane.width, plane.height},
                         [&](int i, int at, float fx, float fy) {
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
    });
  }
}

void PatternSolver::draw_constant(const Taps& taps, SolvedPlanes& out) const {
  const Lit* next = taps.lit.data();
  for (const Tap& t : taps.all) {
    if (!t.lit) continue;
    const Lit& s = *next++;
    glm::vec4 first(0), step(0);
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const auto lane = static_cast<int>(k);
      first[lane] = s.opacity * s.interior[planes_[k]];
      if (planes_[k] != 0) continue;
      first[lane] += (1 - s.opacity) * (s.offset.first - 128.0F * s.gain);
      step[lane] = (1 - s.opacity) * s.offset.step;
    }
    glm::vec4* to = out.row(t.row) + t.first;
    RunValue weight = t.weights();
    for (int i = 0; i < t.count; ++i, weight.first += weight.step, first += step)
      to[i] += weight.first * first;
  }
}

double PatternSolver::mean_weight(const PatternPlanes& planes) const {
  double used = 0;
  std::size_t samples = 0;
  for (const Taps& taps : pictures_)
    for (const Tap& t : taps.all)
      used += static_cast<double>(static_cast<float>(t.count) * t.weights().first);
  for (const SolvedPlanes& p : planes) samples += p.samples.size();
  return used / static_cast<double>(samples);
}

Result<void> PatternSolver::add_transposed(const Draw& draw, std::span<const std::size_t> free,
                                           PatternPlanes& out, Workers& workers) const {
  SolvedPlanes black = out.front();
  clear(black);
  std::vector<SolvedPlanes> drawn(std::min(kTogether, pictures_.size()), black);
  std::vector<Result<void>> done(drawn.size());
  for (std::size_t begin = 0; begin < pictures_.size(); begin += drawn.size()) {
    const std::size_t count = std::min(drawn.size(), pictures_.size() - begin);
    workers.run(static_cast<int>(count), [&](int k, int) {
      clear(drawn[k]);
      done[k] = draw(begin + k, drawn[k]);
    });
    for (std::size_t k = 0; k < count; ++k)
      if (!done[k]) return done[k];
    // In the order of the pictures for each pattern, whoever does it.
    workers.run(static_cast<int>(free.size()), [&](int f, int) {
      for (std::size_t k = 0; k < count; ++k)
        draw_transposed(pictures_[begin + k], free[f], drawn[k], out[f]);
    });
  }
  return {};
}

Result<PatternPlanes> PatternSolver::solve(const Target& target, const PatternPlanes& sources,
                                           std::span<const std::size_t> free, const SolverSettings& settings,
                                           Workers& workers) const {
  SolvedPlanes black = sources.front();
  clear(black);
  PatternPlanes x(free.size(), black);
  // From the anchor on, so that the pull has no part in the first residual.
  PatternPlanes residual = x;
  Shown shown;
  for (const SolvedPlanes& p : sources) shown.push_back(&p);
  const auto first_residual = [&](std::size_t number, SolvedPlanes& out) -> Result<void> {
    draw(pictures_[number], shown, out);
    draw_constant(pictures_[number], out);
    const auto wanted = target(number);
    if (!wanted) return fail(wanted.error());
    for (std::size_t i = 0; i < out.samples.size(); ++i) out.samples[i] = wanted->samples[i] - out.samples[i];
    return {};
  };
  if (auto done = add_transposed(first_residual, free, residual, workers); !done) return fail(done.error());
  PatternPlanes direction = residual, product = x;
  std::fill(shown.begin(), shown.end(), nullptr);
  for (std::size_t f = 0; f < free.size(); ++f) shown[free[f]] = &direction[f];
  const glm::dvec4 pull(settings.pull * mean_weight(sources));
  // The planes are separate problems: each lane has its own steps.
  glm::dvec4 now = dot(residual, residual);
  const glm::dvec4 enough = kConverged * now;
  for (int i = 0; i < settings.iterations; ++i) {
    const glm::bvec4 done = glm::lessThanEqual(now, enough);
    if (glm::all(done)) break;
    for (SolvedPlanes& p : product) clear(p);
    const auto along = [&](std::size_t number, SolvedPlanes& out) -> Result<void> {
      draw(pictures_[number], shown, out);
      return {};
    };
    if (auto added = add_transposed(along, free, product, workers); !added) return fail(added.error());
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
