#include "encoder/blend/pattern_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <opencv2/core/hal/intrin.hpp>

#include "decoder/blend/mesh_blend.h"

namespace fbs {
namespace {

/// A lane has converged when its squared residual has fallen to this share.
constexpr double kConverged = 1e-4;

constexpr float kToOne = 1.0F / kMeshWeightOne;

/// Pictures in memory at a time. They share the patterns near them in time, each of which is one worker's.
constexpr std::size_t kTogether = 16;

using Lanes = cv::v_float32x4;  // a sample of each plane

Lanes load(const glm::vec4& samples) {
  return cv::v_load(&samples.x);
}
void store(const Lanes& from, glm::vec4& to) {
  cv::v_store(&to.x, from);
}

/// Weights along a run, by plane.
struct LaneWeights {
  Lanes now, step;
  LaneWeights(const glm::vec4& texture, const RunValue& weight)
      : now(load(texture * weight.first)), step(load(texture * weight.step)) {}

  /// The same, one sample on.
  [[nodiscard]] Lanes next() {
    const Lanes out = now;
    now += step;
    return out;
  }

  /// to += weights * from
  void add(const glm::vec4* from, int count, glm::vec4* to) {
    for (int i = 0; i < count; ++i) store(load(to[i]) + next() * load(from[i]), to[i]);
  }
};

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
  std::vector<FromPattern> by_pattern;
  for (std::size_t k = 0; k < scene_.patterns.size(); ++k) by_pattern.push_back({k});
  for (std::uint32_t triangle = 0; triangle < surface.triangles().size(); ++triangle) {
    const auto runs = surface.runs_of(triangle);
    if (runs.empty()) continue;
    const auto first_run = static_cast<std::uint32_t>(runs.data() - surface.runs().data()),
               end_run = first_run + static_cast<std::uint32_t>(runs.size());
    const SurfaceTriangle& t = surface.triangles()[triangle];
    const PointWeights& weights = t.head ? blend.head : surround;
    const auto w0 = weights.at(t.corners[0]), w1 = weights.at(t.corners[1]), w2 = weights.at(t.corners[2]);
    for (std::size_t s = 0; s < weights.sources; ++s) {
      if ((w0[s] | w1[s] | w2[s]) == 0) continue;
      const std::size_t k = blend.sources[s].pattern;
      const TriangleSource source = triangle_source(picture, triangle, *textures[k], blend.sources[s].still);
      FromPattern& found = by_pattern[available[k]];
      if (source.place) found.places.push_back(*source.place);
      if (source.light) found.lit.push_back(*source.light);
      found.pieces.push_back({first_run, end_run,
                              between(surface.barycentric(triangle), kToOne * glm::vec3(w0[s], w1[s], w2[s])),
                              t.head, source.place.has_value(), source.light.has_value()});
    }
  }
  Drawn out;
  out.runs.reserve(surface.runs().size());
  for (const SurfaceRun& run : surface.runs())
    out.runs.push_back({static_cast<std::uint16_t>(run.row), static_cast<std::uint16_t>(run.first),
                        static_cast<std::uint16_t>(run.count)});
  for (FromPattern& found : by_pattern) {
    if (found.pieces.empty()) continue;
    found.pieces.shrink_to_fit();
    found.places.shrink_to_fit();
    found.lit.shrink_to_fit();
    out.patterns.push_back(std::move(found));
  }
  pictures_[number] = std::move(out);
}

template <class Use>
void PatternSolver::for_each_run(const std::vector<Run>& runs, const FromPattern& from, Use&& use) const {
  const TexturePlace* next_place = from.places.data();
  const TriangleLight* next_lit = from.lit.data();
  for (const Piece& piece : from.pieces) {
    const TexturePlace* place = piece.moved ? next_place++ : nullptr;
    const TriangleLight* light = piece.lit ? next_lit++ : nullptr;
    for (std::uint32_t r = piece.first_run; r < piece.end_run; ++r) {
      const Run run = runs[r];
      glm::vec4 texture = is_used_;
      if (light != nullptr)
        texture = (texture + light->gain.along(run.row, run.first).first * is_luma_) * (1 - light->opacity);
      const TexturePath path =
          piece.moved ? place->along(run.row, run.first, piece.head ? 0 : inset_) : TexturePath{};
      use(PieceRun{run, path, texture, piece.weight.along(run.row, run.first)}, piece.moved);
    }
  }
}

const PatternSolver::FromPattern* PatternSolver::Drawn::from(std::size_t pattern) const {
  const auto found = std::ranges::find(patterns, pattern, &FromPattern::pattern);
  return found == patterns.end() ? nullptr : &*found;
}

bool PatternSolver::uses(std::size_t pattern) const {
  return std::ranges::any_of(pictures_,
                             [&](const Drawn& picture) { return picture.from(pattern) != nullptr; });
}

std::size_t PatternSolver::bytes() const {
  const auto bytes_of = [](const auto& v) { return v.size() * sizeof(*v.data()); };
  std::size_t bytes = 0;
  for (const Drawn& picture : pictures_) {
    bytes += bytes_of(picture.runs);
    for (const FromPattern& from : picture.patterns)
      bytes += bytes_of(from.pieces) + bytes_of(from.places) + bytes_of(from.lit);
  }
  return bytes;
}

void PatternSolver::draw(const Drawn& picture, const Shown& planes, SolvedPlanes& out) const {
  for (const FromPattern& from : picture.patterns) {
    if (planes[from.pattern] == nullptr) continue;
    const SolvedPlanes& plane = *planes[from.pattern];
    for_each_run(picture.runs, from, [&](const PieceRun& r, bool moved) {
      LaneWeights weights(r.texture, r.weight);
      glm::vec4* to = out.row(r.run.row) + r.run.first;
      if (!moved) {
        weights.add(plane.row(r.run.row) + r.run.first, r.run.count, to);
        return;
      }
      const glm::vec4* samples = plane.samples.data();
      for_each_footprint(r.path, r.run.count, {plane.width, plane.height},
                         [&](int i, int at, float fx, float fy) {
                           const glm::vec4* a = samples + at;
                           const glm::vec4* b = a + plane.width;
                           const Lanes x = cv::v_setall_f32(fx), y = cv::v_setall_f32(fy);
                           const Lanes top = load(a[0]) + x * (load(a[1]) - load(a[0])),
                                       bottom = load(b[0]) + x * (load(b[1]) - load(b[0]));
                           store(load(to[i]) + weights.next() * (top + y * (bottom - top)), to[i]);
                         });
    });
  }
}

void PatternSolver::draw_transposed(const Drawn& picture, std::size_t pattern, const SolvedPlanes& samples,
                                    SolvedPlanes& plane) const {
  const FromPattern* from = picture.from(pattern);
  if (from == nullptr) return;
  for_each_run(picture.runs, *from, [&](const PieceRun& r, bool moved) {
    LaneWeights weights(r.texture, r.weight);
    const glm::vec4* shown = samples.row(r.run.row) + r.run.first;
    if (!moved) {
      weights.add(shown, r.run.count, plane.row(r.run.row) + r.run.first);
      return;
    }
    glm::vec4* all = plane.samples.data();
    for_each_footprint(r.path, r.run.count, {plane.width, plane.height},
                       [&](int i, int at, float fx, float fy) {
                         glm::vec4* a = all + at;
                         glm::vec4* b = a + plane.width;
                         const Lanes x = cv::v_setall_f32(fx), y = cv::v_setall_f32(fy);
                         const Lanes value = weights.next() * load(shown[i]), bottom = value * y,
                                     top = value - bottom, top_right = top * x, bottom_right = bottom * x;
                         store(load(a[0]) + (top - top_right), a[0]);
                         store(load(a[1]) + top_right, a[1]);
                         store(load(b[0]) + (bottom - bottom_right), b[0]);
                         store(load(b[1]) + bottom_right, b[1]);
                       });
  });
}

void PatternSolver::draw_constant(const Drawn& picture, SolvedPlanes& out) const {
  for (const FromPattern& from : picture.patterns) {
    const TriangleLight* next = from.lit.data();
    for (const Piece& piece : from.pieces) {
      if (!piece.lit) continue;
      const TriangleLight& light = *next++;
      for (std::uint32_t r = piece.first_run; r < piece.end_run; ++r)
        add_constant(light, picture.runs[r], piece.weight, out);
    }
  }
}

void PatternSolver::add_constant(const TriangleLight& light, Run run, const TriangleValue& weight,
                                 SolvedPlanes& out) const {
  const RunValue offset = light.offset.along(run.row, run.first);
  const float gain = light.gain.along(run.row, run.first).first;
  glm::vec4 first(0), step(0);
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const auto lane = static_cast<int>(k);
    first[lane] = light.opacity * light.interior[planes_[k]];
    if (planes_[k] != 0) continue;
    first[lane] += (1 - light.opacity) * (offset.first - 128.0F * gain);
    step[lane] = (1 - light.opacity) * offset.step;
  }
  glm::vec4* to = out.row(run.row) + run.first;
  RunValue w = weight.along(run.row, run.first);
  for (int i = 0; i < run.count; ++i, w.first += w.step, first += step) to[i] += w.first * first;
}

double PatternSolver::total_weight() const {
  double out = 0;
  for (const Drawn& picture : pictures_)
    for (const FromPattern& from : picture.patterns)
      for (const Piece& piece : from.pieces)
        for (std::uint32_t r = piece.first_run; r < piece.end_run; ++r) {
          const Run run = picture.runs[r];
          out += static_cast<double>(static_cast<float>(run.count) *
                                     piece.weight.along(run.row, run.first).first);
        }
  return out;
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

Result<PatternPlanes> PatternSolver::solve(const Target& target, PatternPlanes sources,
                                           std::span<const std::size_t> free, const SolverSettings& settings,
                                           Workers& workers) const {
  SolvedPlanes black = sources[free.front()];
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
  for (SolvedPlanes& p : sources) p = {};  // they take much memory
  PatternPlanes direction = residual, product = x;
  std::fill(shown.begin(), shown.end(), nullptr);
  for (std::size_t f = 0; f < free.size(); ++f) shown[free[f]] = &direction[f];
  const double mean_weight = total_weight() / static_cast<double>(sources.size() * black.samples.size());
  const glm::dvec4 pull(settings.pull * mean_weight);
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
