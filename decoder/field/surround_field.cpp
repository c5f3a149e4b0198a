#include "decoder/field/surround_field.h"

#include <algorithm>
#include <utility>

#include "decoder/field/padded_plane.h"
#include "decoder/head/head_projection.h"

namespace fbs {
namespace {

/// Shares of hair and body at a node, in 1/kNodeShareOne; ground has the rest.
struct NodeShares {
  std::int32_t hair = 0, body = 0;
  friend bool operator==(const NodeShares&, const NodeShares&) = default;
};
constexpr std::int32_t kNodeShareOne = 256;

NodeShares shares_at(const NodePlace& place, std::span<const RegionShares> shares) {
  if (!place.is_covered()) return {};
  const auto at = [&](Region region) {
    const auto share = [&](int k) {
      return kNodeShareOne / kShareOne * shares[place.corner[k]][static_cast<std::size_t>(region)];
    };
    return place.mean(share(0), share(1), share(2));
  };
  NodeShares out;
  out.hair = std::clamp(at(Region::kHair), 0, kNodeShareOne);
  out.body = std::clamp(at(Region::kBody), 0, kNodeShareOne - out.hair);
  return out;
}

/// Weights of the sources at a node.
void weigh(const NodeShares& shares, const RegionWeights& regions, std::vector<std::uint16_t>& out) {
  const auto of = [&](Region region, std::size_t s) { return regions[static_cast<std::size_t>(region)][s]; };
  const std::int32_t ground = kNodeShareOne - shares.hair - shares.body;
  std::int32_t left = kNodeWeightOne;
  std::size_t largest = 0;
  for (std::size_t s = 0; s < out.size(); ++s) {
    const std::int32_t sum = shares.hair * of(Region::kHair, s) + shares.body * of(Region::kBody, s) +
                             ground * of(Region::kGround, s);
    out[s] = static_cast<std::uint16_t>(sum / kNodeShareOne);
    left -= out[s];
    if (out[s] > out[largest]) largest = s;
  }
  out[largest] = static_cast<std::uint16_t>(out[largest] + left);
}

}  // namespace

void displace(const NodeCover& cover, std::span<const glm::ivec2> seen, std::span<const glm::ivec2> now,
              int width, int height, SourceField& out) {
  out.moves = !std::equal(seen.begin(), seen.end(), now.begin(), now.end());
  if (!out.moves) return;
  std::vector<glm::ivec2> moved;
  moved.reserve(seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k) moved.push_back(seen[k] - now[k]);
  constexpr int kOutside = kMaxOutside << kScreenOneLog2;
  const glm::ivec2 end(width << kScreenOneLog2, height << kScreenOneLog2);
  const NodeGrid& grid = cover.grid();
  out.displacement.resize(grid.size());
  for (int j = 0, k = 0; j < grid.rows(); ++j) {
    const int y = NodeGrid::place(j);
    for (int i = 0; i < grid.columns(); ++i, ++k) {
      const NodePlace& place = cover.places()[k];
      glm::ivec2& d = out.displacement[k];
      d = {};
      if (!place.is_covered()) continue;
      const glm::ivec2 a = moved[place.corner[0]], b = moved[place.corner[1]], c = moved[place.corner[2]];
      const int x = NodeGrid::place(i);
      if ((a.x | b.x | c.x) != 0)
        d.x = std::clamp(place.mean(a.x, b.x, c.x), -kOutside - x, end.x + kOutside - x);
      if ((a.y | b.y | c.y) != 0)
        d.y = std::clamp(place.mean(a.y, b.y, c.y), -kOutside - y, end.y + kOutside - y);
    }
  }
}

void NodeWeights::set(const NodeCover& cover, const RegionWeights& regions,
                      std::span<const RegionShares> shares) {
  const std::size_t sources = regions.front().size();
  nodes_ = cover.places().size();
  weights_.resize(nodes_ * sources);
  std::vector<std::uint16_t> weights(sources);
  NodeShares last{-1, -1};
  for (std::size_t k = 0; k < nodes_; ++k) {
    const NodeShares here = shares_at(cover.places()[k], shares);
    if (here != last) weigh(here, regions, weights);
    last = here;
    for (std::size_t s = 0; s < sources; ++s) weights_[s * nodes_ + k] = weights[s];
  }
}

void NodeWeights::set(const NodeGrid& grid, std::span<const std::int32_t> weights) {
  nodes_ = grid.size();
  weights_.clear();
  for (const std::int32_t w : weights) weights_.insert(weights_.end(), nodes_, static_cast<std::uint16_t>(w));
}

}  // namespace fbs
