#include "decoder/blend/picture_blend.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "decoder/blend/share_out.h"
#include "decoder/blend/state_distance.h"
#include "decoder/head/fixed_math.h"

namespace fbs {
namespace {

constexpr int kOneLog2 = 16;  // for weights before they are rounded
constexpr std::int64_t kOne = std::int64_t{1} << kOneLog2;

constexpr std::int64_t kExponent = 307;  // weights fall with this power of 1 + the squared distance, 1/256

/// How weights follow from distances in one region.
struct Law {
  std::int64_t state_share;  ///< share of the weights by state in kByState, 1/64; the rest is by time
  std::size_t sources;       ///< maximum number
};
// More sources average out the coding noise of patterns, but take time to draw.
constexpr std::array<Law, kRegionCount> kLaw = {
    {{48, 5}, {64, 3}, {64, 3}, {48, 4}, {48, 3}, {48, 3}, {0, 2}}};

/// Relative weights from squared distances; the nearest weighs most.
std::vector<std::int64_t> fall_off(std::span<const std::int64_t> distances) {
  constexpr int kDigits = 12, kOctaves = 13;
  const auto exponent = [](std::int64_t d) {
    return log2_fixed(static_cast<std::uint64_t>(d + kDistanceOne));
  };
  const std::int64_t least = exponent(*std::min_element(distances.begin(), distances.end()));
  std::vector<std::int64_t> out;
  for (const std::int64_t d : distances) {
    const std::int64_t fall = (exponent(d) - least) * kExponent >> 8;
    const std::int64_t left = (std::int64_t{kOctaves} << kDigits) - fall;
    out.push_back(left < 0 ? 0 : exp2_q16(static_cast<std::int32_t>(left)) >> kOctaves);
  }
  return out;
}

/// Keeps the largest, each reduced by the largest of the others, so that no source appears or vanishes at
/// once.
void keep_largest(std::vector<std::int64_t>& weights, std::size_t count) {
  if (weights.size() <= count) return;
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  const std::int64_t next = weights[order[count]];
  const std::size_t first = order.front();
  for (std::int64_t& w : weights) w = std::max<std::int64_t>(w - next, 0);
  weights[first] = std::max<std::int64_t>(weights[first], 1);
}

/// Sum of sources with weights of any scale; a source may be added twice.
class Mix {
 public:
  void add(BlendSource source, std::int64_t weight) {
    if (weight <= 0) return;
    const auto place =
        std::find_if(items_.begin(), items_.end(), [&](const Item& i) { return i.source == source; });
    if (place != items_.end())
      place->weight += weight;
    else
      items_.push_back({source, weight});
  }
  /// Rounds to a sum of kBlendOne; the largest takes the rounding error.
  [[nodiscard]] RegionBlend rounded() {
    std::sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
      return 2 * a.source.pattern + a.source.still < 2 * b.source.pattern + b.source.still;
    });
    std::int64_t sum = 0;
    for (const Item& i : items_) sum += i.weight;
    std::vector<std::int32_t> weights(items_.size());
    share_out([&](std::size_t k) { return items_[k].weight; }, sum, kBlendOne, weights);
    RegionBlend out;
    for (std::size_t k = 0; k < items_.size(); ++k)
      if (weights[k] != 0) out.push_back({items_[k].source, weights[k]});
    return out;
  }

 private:
  struct Item {
    BlendSource source;
    std::int64_t weight;
  };
  std::vector<Item> items_;
};

BlendSource warped(std::size_t pattern) {
  return {static_cast<std::uint8_t>(pattern), false};
}
BlendSource still(std::size_t pattern) {
  return {static_cast<std::uint8_t>(pattern), true};
}

}  // namespace

BlendWeights::BlendWeights(std::span<const State* const> seen, const State& picture)
    : seen_(seen), picture_(picture) {
  assert(!seen.empty());
  std::size_t before = seen.size(), after = seen.size();
  std::int32_t first = seen[0]->picture, last = first;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const std::int32_t number = seen[k]->picture;
    first = std::min(first, number);
    last = std::max(last, number);
    if (number <= picture.picture) {
      if (before == seen.size() || number > seen[before]->picture) before = k;
    } else if (after == seen.size() || number < seen[after]->picture) {
      after = k;
    }
  }
  const auto gaps = static_cast<std::int32_t>(std::max<std::size_t>(seen.size() - 1, 1));
  spacing_ = std::max(1, (last - first) / gaps);
  before_ = before < seen.size() ? before : after;
  after_ = after < seen.size() ? after : before_;
  if (before_ != after_)
    share_after_ = (std::int64_t{picture.picture} - seen[before_]->picture) * kOne /
                   (std::int64_t{seen[after_]->picture} - seen[before_]->picture);
}

std::vector<std::int64_t> BlendWeights::distances(Region region) const {
  std::vector<std::int64_t> out;
  out.reserve(seen_.size());
  for (const State* s : seen_) out.push_back(state_distance(region, *s, picture_, spacing_));
  return out;
}

/// The weights sum to about kOne.
BlendWeights::Weights BlendWeights::by_state(Region region) const {
  Weights weights = fall_off(distances(region));
  const std::int64_t sum = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
  const Law& law = kLaw[static_cast<std::size_t>(region)];
  for (std::int64_t& w : weights) w = w * kOne / sum * law.state_share / 64;
  weights[before_] += (kOne - share_after_) * (64 - law.state_share) / 64;
  weights[after_] += share_after_ * (64 - law.state_share) / 64;
  keep_largest(weights, law.sources);
  return weights;
}

RegionBlend BlendWeights::blend(Region region, BlendMode mode) const {
  Mix mix;
  const auto cross_fade = [&](bool without_motion, std::int64_t total) {
    const std::int64_t second = total * share_after_ >> kOneLog2;
    mix.add({static_cast<std::uint8_t>(before_), without_motion}, total - second);
    mix.add({static_cast<std::uint8_t>(after_), without_motion}, second);
  };
  if (mode == BlendMode::kByTime) {
    cross_fade(false, kOne);
  } else if (mode == BlendMode::kStillBefore) {
    mix.add(still(before_), kOne);
  } else if (mode == BlendMode::kStillAfter) {
    mix.add(still(after_), kOne);
  } else {
    const Weights weights = by_state(region);
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      mix.add(warped(k), weights[k]);
      sum += weights[k];
    }
    if (mode == BlendMode::kHalfStill) {
      cross_fade(true, sum);
    } else if (mode >= BlendMode::kNearest) {
      const std::vector<std::int64_t> d = distances(region);
      std::vector<std::size_t> order(d.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return d[a] < d[b]; });
      const std::size_t rank = static_cast<std::size_t>(mode) - static_cast<std::size_t>(BlendMode::kNearest);
      mix.add(warped(order[std::min(rank, order.size() - 1)]), sum);
    }
  }
  return mix.rounded();
}

PictureBlend blend_picture(std::span<const State* const> seen, const State& picture) {
  const BlendWeights weights(seen, picture);
  PictureBlend out;
  for (std::size_t r = 0; r < kRegionCount; ++r)
    out[r] = weights.blend(static_cast<Region>(r), picture.blend[r]);
  return out;
}

}  // namespace fbs
