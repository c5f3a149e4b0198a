#include "decoder/field/warp_kernels_plain.h"

namespace fbs::plain {
namespace {

constexpr int kFractionOne = 1 << kFractionOneLog2;

int nearest(int value) {
  return (value + kFractionOne / 2) >> kFractionOneLog2;
}

std::uint8_t bilinear(const std::uint8_t* at, std::ptrdiff_t stride, int p, int q) {
  const int top = at[0] * (kFractionOne - p) + at[1] * p;
  const int bottom = at[stride] * (kFractionOne - p) + at[stride + 1] * p;
  return static_cast<std::uint8_t>(nearest(top + nearest((bottom - top) * q)));
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
          bilinear(from + row * stride + column, stride, dx & (kFractionOne - 1), dy & (kFractionOne - 1));
    }
  }
}

}  // namespace

void warp_even_luma(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                    std::uint8_t* out) {
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      out[y * WarpedBlock::kStride + x] = bilinear(from + y * stride + x, stride, fraction.x, fraction.y);
}

void warp_even_chroma(const ChromaSamples& from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                      const ChromaOut& out) {
  for (std::size_t k = 0; k < 2; ++k) warp_even_luma(from[k], stride, fraction, size, out[k]);
}

void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out) {
  warp_bent(from, stride, nodes, 1, out);
}

void warp_bent_chroma(const ChromaSamples& from, std::ptrdiff_t stride, const PatchNodes& nodes,
                      const ChromaOut& out) {
  for (std::size_t k = 0; k < 2; ++k) warp_bent(from[k], stride, nodes, 2, out[k]);
}

}  // namespace fbs::plain
