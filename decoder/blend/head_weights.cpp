#include "decoder/blend/head_weights.h"

#include <numeric>

#include "decoder/blend/share_out.h"

namespace fbs {
namespace {

bool shows(const PointWeights& weights, std::size_t source) {
  for (std::size_t k = source; k < weights.weights.size(); k += weights.sources)
    if (weights.weights[k] != 0) return true;
  return false;
}

/// Scales weights to a sum of kMeshWeightOne.
/// @param sum  of the weights, not zero
void add_row(std::span<const std::int64_t> weights, std::int64_t sum, std::vector<std::int32_t>& out) {
  out.resize(out.size() + weights.size());
  share_out([&](std::size_t k) { return weights[k]; }, sum, kMeshWeightOne,
            std::span(out).last(weights.size()));
}

/// Sums of the weights of some sources over the vertices of the head, without the ring.
std::vector<std::int64_t> totals(const PointWeights& head, std::size_t head_count,
                                 const std::vector<std::size_t>& sources) {
  std::vector<std::int64_t> out(sources.size());
  for (std::size_t v = 0; v < head_count; ++v)
    for (std::size_t k = 0; k < sources.size(); ++k) out[k] += head.at(v)[sources[k]];
  return out;
}

}  // namespace

HeadWeights head_weights(const MeshBlend& blend, const WireFrame& head) {
  const std::size_t head_count = head.vertices.size();
  HeadWeights out;
  for (std::size_t s = 0; s < blend.sources.size(); ++s)
    if (shows(blend.head, s)) (blend.sources[s].still ? out.still : out.warped).push_back(s);
  out.atlas.sources = out.warped.size();
  out.screen.sources = 1 + out.still.size();
  const std::vector<std::int64_t> all = totals(blend.head, head_count, out.warped);
  std::vector<std::int64_t> weights(out.warped.size());
  for (std::size_t v = 0; v < head_count + head.outline.size(); ++v) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] = blend.head.at(v)[out.warped[k]];
    out.screen.weights.push_back(static_cast<std::int32_t>(sum));
    for (const std::size_t s : out.still) out.screen.weights.push_back(blend.head.at(v)[s]);
    if (weights.empty()) continue;
    if (sum == 0 && v >= head_count) {  // as at the outline, so that the ring fades into the still sources
      const auto same = out.atlas.at(head.outline[v - head_count]);
      weights.assign(same.begin(), same.end());
      sum = kMeshWeightOne;
    } else if (sum == 0) {
      weights = all;
      sum = std::accumulate(all.begin(), all.end(), std::int64_t{0});
    }
    // If only the ring shows a source, there may be no other.
    if (sum == 0) weights.front() = sum = 1;
    add_row(weights, sum, out.atlas.weights);
  }
  return out;
}

}  // namespace fbs
