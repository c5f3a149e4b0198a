#include "decoder/field/displaced_samples.h"

namespace fbs {
namespace {

constexpr int kChromaPatchSize = kPatchSize / 2;

/// A place in textures of one size.
struct Place {
  glm::ivec2 sample;    ///< to its upper left
  glm::ivec2 fraction;  ///< beyond that, 1/64 sample

  /// @param by  displacement of the corner, 1/64 sample
  Place(glm::ivec2 corner, glm::ivec2 by)
      : sample(corner + glm::ivec2(by.x >> kFractionOneLog2, by.y >> kFractionOneLog2)),
        fraction(by & ((1 << kFractionOneLog2) - 1)) {}
  [[nodiscard]] bool is_whole() const { return fraction == glm::ivec2(0); }
  [[nodiscard]] const std::uint8_t* in(const PaddedPlane& plane) const {
    return plane.at(sample.x, sample.y);
  }
};

/// Displacement of a chroma sample, in 1/64 chroma sample.
glm::ivec2 chroma_displacement(glm::ivec2 luma) {
  return {luma.x >> 1, luma.y >> 1};
}

ChromaSamples chroma_at(const PaddedPicture& texture, glm::ivec2 sample) {
  return {texture[1].at(sample.x, sample.y), texture[2].at(sample.x, sample.y)};
}

}  // namespace

BlockSamples3 displaced_block(const PaddedPicture& texture, glm::ivec2 block, glm::ivec2 by, bool has_chroma,
                              BlockMemory& memory) {
  BlockSamples3 out{};
  const Place luma(block * kBlockSize, by);
  if (begins_cache_line(block.x, 0))
    prefetch_next_blocks({luma.in(texture[0]), texture[0].stride()}, kBlockSize + 1);
  if (luma.is_whole()) {
    out[0] = {luma.in(texture[0]), texture[0].stride()};
  } else {
    std::uint8_t* const to = memory[0].samples.data();
    warp_even_luma(luma.in(texture[0]), texture[0].stride(), luma.fraction, kBlockSize, to);
    out[0] = {to, WarpedBlock::kStride};
  }
  if (!has_chroma) return out;
  const Place chroma(block * kChromaBlockSize, chroma_displacement(by));
  const ChromaSamples from = chroma_at(texture, chroma.sample);
  const std::ptrdiff_t stride = texture[1].stride();
  if (begins_cache_line(block.x, 1))
    for (const std::uint8_t* const samples : from)
      prefetch_next_blocks({samples, stride}, kChromaBlockSize + 1);
  if (chroma.is_whole()) {
    out[1] = {from[0], stride};
    out[2] = {from[1], stride};
  } else {
    const ChromaOut to{memory[1].samples.data(), memory[2].samples.data()};
    warp_even_chroma(from, stride, chroma.fraction, kChromaBlockSize, to);
    out[1] = {to[0], WarpedBlock::kStride};
    out[2] = {to[1], WarpedBlock::kStride};
  }
  return out;
}

void draw_even_patch(const PaddedPicture& texture, glm::ivec2 patch, glm::ivec2 by, bool has_chroma,
                     const std::array<std::uint8_t*, 3>& out) {
  const Place luma(patch * kPatchSize, by);
  warp_even_luma(luma.in(texture[0]), texture[0].stride(), luma.fraction, kPatchSize, out[0]);
  if (!has_chroma) return;
  const Place chroma(patch * kChromaPatchSize, chroma_displacement(by));
  warp_even_chroma(chroma_at(texture, chroma.sample), texture[1].stride(), chroma.fraction, kChromaPatchSize,
                   {out[1], out[2]});
}

void draw_bent_patch(const PaddedPicture& texture, glm::ivec2 patch, const PatchNodes& nodes, bool has_chroma,
                     const std::array<std::uint8_t*, 3>& out) {
  const glm::ivec2 luma = patch * kPatchSize;
  warp_bent_luma(texture[0].at(luma.x, luma.y), texture[0].stride(), nodes, out[0]);
  if (has_chroma)
    warp_bent_chroma(chroma_at(texture, patch * kChromaPatchSize), texture[1].stride(), nodes,
                     {out[1], out[2]});
}

}  // namespace fbs
