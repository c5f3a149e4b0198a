#include "decoder/animate/region_shares.h"

#include <algorithm>

#include "bitstream/syntax.h"

namespace fbs {
namespace {

/// The region that a control point moves.
Region region_of(std::size_t control) {
  const auto moves = [&](FeatureId id) {
    return control >= feature(id).first_control &&
           control < std::size_t{feature(id).first_control} + feature(id).control_count;
  };
  if (moves(FeatureId::kMouthOuter) || moves(FeatureId::kMouthInner)) return Region::kMouth;
  if (moves(FeatureId::kUpperLidRight) || moves(FeatureId::kLowerLidRight) || moves(FeatureId::kPupilRight))
    return Region::kRightEye;
  if (moves(FeatureId::kUpperLidLeft) || moves(FeatureId::kLowerLidLeft) || moves(FeatureId::kPupilLeft))
    return Region::kLeftEye;
  return Region::kFace;
}

}  // namespace

std::vector<RegionShares> vertex_shares(const WireFrame& head) {
  std::vector<RegionShares> out(head.vertices.size());
  for (std::size_t v = 0; v < out.size(); ++v) {
    std::array<int, kRegionCount> weight{};
    for (const SkinningWeight& s : head.skinning_of(v))
      weight[static_cast<std::size_t>(region_of(s.control))] += s.weight;
    int left = kShareOne;
    for (const Region region : {Region::kMouth, Region::kRightEye, Region::kLeftEye}) {
      const auto r = static_cast<std::size_t>(region);
      const int share = std::clamp(weight[r] * kShareOne / kSkinningOne, 0, left);
      out[v][r] = static_cast<std::uint8_t>(share);
      left -= share;
    }
    out[v][static_cast<std::size_t>(Region::kFace)] = static_cast<std::uint8_t>(left);
  }
  return out;
}

RegionShares surround_shares(std::int32_t head, std::int32_t body) {
  static_assert(kShareOne == kFollowOne * kFollowOne);
  RegionShares out{};
  const auto set = [&](Region region, std::int32_t share) {
    out[static_cast<std::size_t>(region)] = static_cast<std::uint8_t>(share);
  };
  set(Region::kHair, head * kFollowOne);
  set(Region::kBody, (kFollowOne - head) * body);
  set(Region::kGround, (kFollowOne - head) * (kFollowOne - body));
  return out;
}

}  // namespace fbs
