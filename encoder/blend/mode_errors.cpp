#include "encoder/blend/mode_errors.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "encoder/blend/sample_kernels.h"

namespace fbs {
namespace {

/// How far a part of the face may lie from where a pattern shows it and still be drawn from there without
/// motion, mean over its triangles, eye distances. Farther off, an eye of skin may have the least error.
constexpr double kStillWithin = 0.03;

/// The region with the largest share of a triangle.
Region region_of(const SurfaceTriangle& t, const SceneGeometry& geometry) {
  const auto& shares = t.head ? geometry.head_shares() : geometry.surround().shares();
  std::array<int, kRegionCount> sum{};
  for (const std::uint16_t c : t.corners)
    for (std::size_t r = 0; r < kRegionCount; ++r) sum[r] += shares[c][r];
  return static_cast<Region>(std::max_element(sum.begin(), sum.end()) - sum.begin());
}

/// The triangles that show in each region.
std::array<std::vector<std::uint32_t>, kRegionCount> triangles_by_region(const VisibleSurface& surface,
                                                                         const SceneGeometry& geometry) {
  std::array<std::vector<std::uint32_t>, kRegionCount> out;
  for (std::uint32_t k = 0; k < surface.triangles().size(); ++k)
    if (!surface.runs_of(k).empty())
      out[static_cast<std::size_t>(region_of(surface.triangles()[k], geometry))].push_back(k);
  return out;
}

/// How far triangles of the head lie from where a pattern shows them: mean over their corners, eye distances.
double distance_from(const TextureMesh& texture, const PictureMesh& picture, const WireFrame& frame,
                     std::span<const std::uint32_t> triangles) {
  const auto at = [&](std::size_t vertex) { return glm::dvec2(picture.mesh.head[vertex]); };
  double sum = 0, corners = 1;
  for (const std::uint32_t k : triangles) {
    const SurfaceTriangle& t = picture.surface.triangles()[k];
    if (!t.head) continue;
    for (const std::uint16_t c : t.corners) sum += glm::length(at(c) - glm::dvec2(texture.head[c]));
    corners += 3;
  }
  const auto [right, left] = frame.pupil_vertices();
  return sum / (corners * std::max(1.0, glm::length(at(right) - at(left))));
}

using Samples = std::vector<std::int16_t>;

/// Errors of one region's sources, sampled once each, and their products.
class RegionGram {
 public:
  template <class SampleSource>
  double error(const RegionBlend& blend, SampleSource&& sample) {
    double sum = 0;
    std::vector<std::size_t> index;
    for (const WeightedSource& s : blend) index.push_back(find(s.source, sample));
    for (std::size_t i = 0; i < blend.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        sum += (i == j ? 1 : 2) * static_cast<double>(blend[i].weight * blend[j].weight) *
               product(index[i], index[j]);
    return sum / (kBlendOne * kBlendOne);
  }

 private:
  template <class SampleSource>
  std::size_t find(BlendSource source, SampleSource&& sample) {
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (sources_[i] == source) return i;
    sources_.push_back(source);
    errors_.push_back(sample(source));
    products_.resize(sources_.size() * (sources_.size() + 1) / 2, -1);
    known_.resize(products_.size(), false);
    return sources_.size() - 1;
  }
  double product(std::size_t i, std::size_t j) {
    if (i < j) std::swap(i, j);
    const std::size_t k = i * (i + 1) / 2 + j;
    if (!known_[k]) {
      products_[k] = static_cast<double>(error_product(errors_[i], errors_[j]));
      known_[k] = true;
    }
    return products_[k];
  }

  std::vector<BlendSource> sources_;
  std::vector<Samples> errors_;
  std::vector<double> products_;
  std::vector<bool> known_;
};

}  // namespace

BlendErrors::BlendErrors(const BlendScene& scene, int reduction)
    : scene_(scene), reduction_(reduction), reduced_(new Reduced[scene.patterns.size()]) {}

const ReducedPlane& BlendErrors::luma_of(std::size_t pattern) const {
  Reduced& r = reduced_[pattern];
  std::call_once(r.once, [&] { r.luma = reduce(scene_.patterns[pattern].picture.y, reduction_); });
  return r.luma;
}

ModeErrors BlendErrors::errors(const Plane& source, const State& state,
                               std::span<const std::size_t> available) const {
  const ScreenMesh mesh = scene_.geometry.screen_mesh(state);
  const VisibleSurface surface(scene_.geometry, mesh, source.width, source.height, reduction_);
  const PictureMesh picture{surface, mesh, scene_.mouth, reduction_};
  const auto triangles = triangles_by_region(surface, scene_.geometry);
  const ReducedPlane target = reduce(source, reduction_);
  std::vector<const State*> seen;
  for (const std::size_t k : available) seen.push_back(&scene_.patterns[k].seen);
  const BlendWeights weights(seen, state);

  ModeErrors out{};
  const double scale = static_cast<double>(1 << (2 * reduction_));
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    if (triangles[r].empty()) continue;
    std::size_t samples = 0;
    for (const std::uint32_t triangle : triangles[r])
      for (const SurfaceRun& run : surface.runs_of(triangle)) samples += static_cast<std::size_t>(run.count);
    ShownSamples shown(samples);
    std::vector<std::size_t> ends;  // of the triangles' samples
    for (const std::uint32_t triangle : triangles[r]) {
      for (const SurfaceRun& run : surface.runs_of(triangle)) shown.add(run, target);
      ends.push_back(shown.size());
    }
    const auto sample = [&](BlendSource s) {
      const std::size_t pattern = available[s.pattern];
      const ReducedPlane& luma = luma_of(pattern);
      const TextureMesh& texture = scene_.patterns[pattern].texture;
      Samples error(shown.size() + ShownSamples::kLanes);
      std::size_t begin = 0;
      for (std::size_t k = 0; k < ends.size(); begin = ends[k++])
        shown.differences(triangle_source(picture, triangles[r][k], texture, s.still), luma, begin, ends[k],
                          &error[begin]);
      error.resize(shown.size());
      return error;
    };
    const auto is_torn = [&](const WeightedSource& s) {
      return s.source.still && r <= static_cast<std::size_t>(Region::kFace) &&
             distance_from(scene_.patterns[available[s.source.pattern]].texture, picture,
                           scene_.geometry.geometry().wire_frame(), triangles[r]) > kStillWithin;
    };
    RegionGram gram;
    for (int mode = 0; mode < kBlendModeCount; ++mode) {
      const RegionBlend blend = weights.blend(static_cast<Region>(r), static_cast<BlendMode>(mode));
      out[r][mode] = std::ranges::any_of(blend, is_torn) ? kTorn : scale * gram.error(blend, sample);
    }
  }
  return out;
}

}  // namespace fbs
