// What the kernels of patch_kernels.h compute, one sample after the other. For tests.
#pragma once

#include "decoder/field/patch_kernels.h"

namespace fbs::plain {

void blend_luma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride);
void blend_chroma_block(std::span<const BlendedSource> sources, std::uint8_t* out, std::ptrdiff_t stride);
void warp_even(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, glm::ivec2 size,
               std::uint8_t* out);
void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out);
void warp_bent_chroma(const std::array<const std::uint8_t*, 2>& from, std::ptrdiff_t stride,
                      const PatchNodes& nodes, const std::array<std::uint8_t*, 2>& out);

}  // namespace fbs::plain
