#include "decoder/blend/mesh_blend.h"

#include <algorithm>
#include <numeric>

#include "decoder/blend/share_out.h"

namespace fbs {
namespace {

bool before(const BlendSource& a, const BlendSource& b) {
  return 2 * a.pattern + a.still < 2 * b.pattern + b.still;
}

std::vector<BlendSource> sources_of(const PictureBlend& blend) {
  std::vector<BlendSource> out;
  for (const RegionBlend& region : blend)
    for (const WeightedSource& s : region) out.push_back(s.source);
  std::sort(out.begin(), out.end(), before);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

RegionWeights region_weights(const PictureBlend& blend, std::span<const BlendSource> sources) {
  RegionWeights out;
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    out[r].resize(sources.size());
    for (const WeightedSource& s : blend[r])
      out[r][std::lower_bound(sources.begin(), sources.end(), s.source, before) - sources.begin()] = s.weight;
  }
  return out;
}

/// A source counts as fully visible at a vertex from 1 / kEnoughArea of the drawn area on. 1 and 4 save 1 %
/// less of the rate in the face (five clips).
constexpr int kEnoughArea = 2;
constexpr std::int32_t kVisibleOne = 256;

/// @param seen   area at a vertex in a pattern
/// @param drawn  area at the same vertex in the picture
std::int32_t visibility(std::int64_t seen, std::int64_t drawn) {
  if (drawn == 0 || kEnoughArea * seen >= drawn) return kVisibleOne;
  return static_cast<std::int32_t>(kEnoughArea * kVisibleOne * seen / drawn);
}

/// Takes weight from sources in which the point is hardly visible, unless it is so in all.
void keep_visible(std::span<std::int32_t> weights, std::span<const std::int32_t> visible) {
  std::int64_t sum = 0;
  for (std::size_t s = 0; s < weights.size(); ++s) sum += std::int64_t{weights[s]} * visible[s];
  if (sum == 0) return;
  share_out([&](std::size_t s) { return std::int64_t{weights[s]} * visible[s]; }, sum, kMeshWeightOne,
            weights);
}

}  // namespace

PointWeights point_weights(const RegionWeights& regions, std::span<const RegionShares> shares) {
  PointWeights out;
  out.sources = regions.front().size();
  out.weights.resize(shares.size() * out.sources);
  for (std::size_t p = 0; p < shares.size(); ++p)
    for (std::size_t r = 0; r < kRegionCount; ++r)
      if (shares[p][r] != 0)
        for (std::size_t s = 0; s < out.sources; ++s)
          out.weights[p * out.sources + s] += shares[p][r] * regions[r][s];
  return out;
}

MeshBlend blend_regions(const PictureBlend& blend) {
  MeshBlend out;
  out.sources = sources_of(blend);
  out.regions = region_weights(blend, out.sources);
  return out;
}

MeshBlend blend_mesh(const PictureBlend& blend, const SceneGeometry& geometry,
                     std::span<const TextureMesh* const> textures, const ScreenMesh& mesh) {
  MeshBlend out = blend_regions(blend);
  out.head = point_weights(out.regions, geometry.head_shares());
  std::vector<std::int32_t> visible(out.sources.size());
  for (std::size_t v = 0; v < geometry.head_mesh().head_count; ++v) {
    for (std::size_t s = 0; s < visible.size(); ++s)
      visible[s] = out.sources[s].still
                       ? kVisibleOne
                       : visibility(textures[out.sources[s].pattern]->areas[v], mesh.areas[v]);
    keep_visible(std::span(out.head.weights).subspan(v * out.head.sources, out.head.sources), visible);
  }
  return out;
}

}  // namespace fbs
