#include "decoder/field/patch_motion.h"

#include <algorithm>

namespace fbs {
namespace {

/// Differences within a patch that nobody sees, 1/64 luma sample.
constexpr std::int32_t kEvenEnough = 16;

bool is_even_enough(const PatchNodes& d) {
  const auto [left, right] = std::minmax({d[0].x, d[1].x, d[2].x, d[3].x});
  const auto [top, bottom] = std::minmax({d[0].y, d[1].y, d[2].y, d[3].y});
  return right - left <= kEvenEnough && bottom - top <= kEvenEnough;
}

glm::ivec2 mean_of(const PatchNodes& d) {
  const glm::ivec2 sum = d[0] + d[1] + d[2] + d[3];
  return {(sum.x + 2) >> 2, (sum.y + 2) >> 2};
}

/// A place in a texture.
struct Place {
  const std::uint8_t* from;  ///< the sample to its upper left
  glm::ivec2 fraction;       ///< beyond that, 1/64 sample

  /// @param by  displacement of the corner, 1/64 sample
  Place(const PaddedPlane& texture, glm::ivec2 corner, glm::ivec2 by)
      : from(texture.at(corner.x + (by.x >> kFractionOneLog2), corner.y + (by.y >> kFractionOneLog2))),
        fraction(by & ((1 << kFractionOneLog2) - 1)) {}
};

void warp_even_patch(const PaddedPlane& texture, glm::ivec2 corner, glm::ivec2 by, int size,
                     std::uint8_t* out) {
  const Place place(texture, corner, by);
  warp_even(place.from, texture.stride(), place.fraction, {size, size}, out);
}

}  // namespace

PatchMotion PatchMotion::between(const PatchNodes& nodes) {
  if (std::all_of(nodes.begin(), nodes.end(), [](glm::ivec2 d) { return d == glm::ivec2(0); })) return {};
  if (!is_even_enough(nodes)) return {Kind::kBent, nodes};
  const glm::ivec2 mean = mean_of(nodes);
  return {Kind::kEven, {mean, mean, mean, mean}};
}

BlockMotion BlockMotion::of(const glm::ivec2* nodes, int columns) {
  const glm::ivec2 *const upper = nodes, *const middle = nodes + columns, *const lower = middle + columns;
  BlockMotion out;
  int any = 0;
  for (int i = 0; i < 3; ++i)
    any |= upper[i].x | upper[i].y | middle[i].x | middle[i].y | lower[i].x | lower[i].y;
  if (any == 0) return out;
  out.patch = {PatchMotion::between({upper[0], upper[1], middle[0], middle[1]}),
               PatchMotion::between({upper[1], upper[2], middle[1], middle[2]}),
               PatchMotion::between({middle[0], middle[1], lower[0], lower[1]}),
               PatchMotion::between({middle[1], middle[2], lower[1], lower[2]})};
  const PatchMotion& first = out.patch[0];
  const bool is_even = first.kind == PatchMotion::Kind::kEven &&
                       std::all_of(out.patch.begin(), out.patch.end(), [&](const PatchMotion& p) {
                         return p.kind == first.kind && p.nodes[0] == first.nodes[0];
                       });
  out.whole = is_even ? Whole::kEven : Whole::kNo;
  return out;
}

SampleBlock displaced(const PaddedPlane& texture, glm::ivec2 corner, glm::ivec2 by, int size,
                      std::uint8_t* out) {
  const Place place(texture, corner, by);
  if (place.fraction == glm::ivec2(0)) return {place.from, texture.stride()};
  warp_even(place.from, texture.stride(), place.fraction, {size, size}, out);
  return {out, WarpedBlock::kStride};
}

void warp_luma(const PaddedPlane& texture, const PatchMotion& motion, glm::ivec2 corner, std::uint8_t* out) {
  if (motion.kind == PatchMotion::Kind::kEven)
    warp_even_patch(texture, corner, motion.nodes[0], kPatchSize, out);
  else
    warp_bent_luma(texture.at(corner.x, corner.y), texture.stride(), motion.nodes, out);
}

void warp_chroma(const PaddedPlane& u, const PaddedPlane& v, const PatchMotion& motion, glm::ivec2 corner,
                 const std::array<std::uint8_t*, 2>& out) {
  if (motion.kind == PatchMotion::Kind::kEven) {
    const glm::ivec2 by = chroma_displacement(motion.nodes[0]);
    warp_even_patch(u, corner, by, kPatchSize / 2, out[0]);
    warp_even_patch(v, corner, by, kPatchSize / 2, out[1]);
  } else {
    warp_bent_chroma({u.at(corner.x, corner.y), v.at(corner.x, corner.y)}, u.stride(), motion.nodes, out);
  }
}

}  // namespace fbs
