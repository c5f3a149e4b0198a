// The definition of warp_kernels.h, one sample after another.
#pragma once

#include "decoder/field/warp_kernels.h"

namespace fbs::plain {

void warp_even_luma(const std::uint8_t* from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                    std::uint8_t* out);
void warp_even_chroma(const ChromaSamples& from, std::ptrdiff_t stride, glm::ivec2 fraction, int size,
                      const ChromaOut& out);
void warp_bent_luma(const std::uint8_t* from, std::ptrdiff_t stride, const PatchNodes& nodes,
                    std::uint8_t* out);
void warp_bent_chroma(const ChromaSamples& from, std::ptrdiff_t stride, const PatchNodes& nodes,
                      const ChromaOut& out);

}  // namespace fbs::plain
