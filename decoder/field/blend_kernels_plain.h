// The definition of blend_kernels.h, one sample after another.
#pragma once

#include "decoder/field/blend_kernels.h"

namespace fbs::plain {

void blend_luma_block(std::span<const BlendedSource> sources, NodeSteps steps, std::uint8_t* out,
                      std::ptrdiff_t stride);
void blend_chroma_block(std::span<const BlendedSource> sources, NodeSteps steps,
                        const std::array<std::uint8_t*, 2>& out, std::ptrdiff_t stride);

}  // namespace fbs::plain
