#include "decoder/field/blend_kernels_plain.h"

namespace fbs::plain {
namespace {

/// @param u     at the block's upper left node
/// @param x, y  luma sample of the block
int weight_at(const std::uint16_t* u, NodeSteps steps, int x, int y) {
  u += y / kPatchSize * steps.line + x / kPatchSize * steps.column;
  const int k = x % kPatchSize, l = y % kPatchSize;
  const int top = u[0] * (kPatchSize - k) + u[steps.column] * k;
  const int bottom = u[steps.line] * (kPatchSize - k) + u[steps.line + steps.column] * k;
  return top * (kPatchSize - l) + bottom * l;
}

/// @param step  luma samples per sample
void blend_block(std::span<const BlendedSource> sources, NodeSteps steps, std::size_t plane, int step,
                 std::uint8_t* out, std::ptrdiff_t stride) {
  for (int y = 0; y < kBlockSize / step; ++y) {
    for (int x = 0; x < kBlockSize / step; ++x) {
      int sum = 32;
      for (const BlendedSource& s : sources) {
        const SampleBlock& from = s.planes[plane];
        sum += weight_at(s.weight, steps, x * step, y * step) * from.samples[y * from.stride + x] >> 8;
      }
      out[y * stride + x] = static_cast<std::uint8_t>(sum >> 6);
    }
  }
}

}  // namespace

void blend_luma_block(std::span<const BlendedSource> sources, NodeSteps steps, std::uint8_t* out,
                      std::ptrdiff_t stride) {
  blend_block(sources, steps, 0, 1, out, stride);
}

void blend_chroma_block(std::span<const BlendedSource> sources, NodeSteps steps,
                        const std::array<std::uint8_t*, 2>& out, std::ptrdiff_t stride) {
  for (std::size_t k = 0; k < 2; ++k) blend_block(sources, steps, 1 + k, 2, out[k], stride);
}

}  // namespace fbs::plain
