#include "decoder/field/patch_kernels_plain.h"

namespace fbs::plain {
namespace {

constexpr int kOne = 1 << kFractionOneLog2;

int nearest(int value) {
  return (value + kOne / 2) >> kFractionOneLog2;
}

std::uint8_t bilinear(const std::uint8_t* at, std::ptrdiff_t stride, int p, int q) {
  const int top = at[0] * (kOne - p) + at[1] * p;
  const int bottom = at[stride] * (kOne - p) + at[stride + 1] * p;
  return static_cast<std::uint8_t>(nearest(top + nearest((bottom - top) * q)));
}

/// @param u     at nine nodes
/// @param x, y  luma sample of the block
int weight_at(const std::array<std::uint16_t, 9>& u, int x, int y) {
  const int first = y / kPatchSize * 3 + x / kPatchSize;
  const int k = x % kPatchSize, l = y % kPatchSize;
  const int top = u[first] * (kPatchSize - k) + u[first + 1] * k;
  const int bottom = u[first + 3] * (kPatchSize - k) + u[first + 4] * k;
  return top * (kPatchSize - l) + bottom * l;
}

/// @param step  luma samples per sample
void blend_block(std::span<const BlendedSource> sources, int step, std::uint8_t* out, std::ptrdiff_t stride) {
  for (int y = 0; y < kBlockSize / step; ++y) {
    for (int x = 0; x < kBlockSize / step; ++x) {
      int sum = 0;
      for (const BlendedSource& s : sources)
        sum += weight_at(s.weight, x * step, y * step) * s.block.samples[y * s.block.stride + x] >> 8;
      out[y * stride + x] = static_cast<std::uint8_t>(nearest(sum));
    }
  }
}

/// One coordinate of the displacement of a luma sample of a patch.
int displacement(const PatchNodes& nodes, int glm::ivec2::*axis, int k, int l) {
  const int top = nodes[0].*axis * (kPatchSize - k) + nodes[1].*axis * k;
  const int bottom = nodes[2].*axis * (kPatchSize - k) + nodes[3].*axis * k;
  return nearest(top * (kPatchSize - l) + bottom * l);
}

/// @param step  luma samples per sample
void warp_bent(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes, int step,
               std::uint8_t* out) {
  for (int y = 0; y < kPatchSize / step; ++y) {
    for (int x = 0; x < kPatchSize / step; ++x) {
      const int dx = displacement(nodes, &glm::ivec2::x, x * step, y * step) >> (step - 1);
      const int dy = displacement(nodes, &glm::ivec2::y, x * step, y * step) >> (step - 1);
      const int column = x + (dx >> kFractionOneLog2), row = y + (dy >> kFractionOneLog2);
      out[y * WarpedBlock::kStride + x] =
          bilinear(from + row * stride + column, stride, dx & (kOne - 1), dy & (kOne - 1));
    }
  }
}

}  // namespace

void blend_luma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride) {
  blend_block(sources, 1, out, stride);
}

void blend_chroma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride) {
  blend_block(sources, 2, out, stride);
}

void warp_even(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, glm::ivec2 size,
               std::uint8_t* out) {
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      out[y * WarpedBlock::kStride + x] = bilinear(from + y * stride + x, stride, fraction.x, fraction.y);
}

void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out) {
  warp_bent(from, stride, nodes, 1, out);
}

void warp_bent_chroma(const std::array<const std::uint8_t*, 2>& from, std::ptrdiff_t stride,
                      const PatchNodes& nodes, const std::array<std::uint8_t*, 2>& out) {
  for (std::size_t plane = 0; plane < 2; ++plane) warp_bent(from[plane], stride, nodes, 2, out[plane]);
}

}  // namespace fbs::plain
