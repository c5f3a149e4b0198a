// Included before Highway by files with kernels, which need vectors of a known size, 16 or 32 bytes.
// Processors with vectors of any size (SVE, RISC-V) use the smaller set that they also have.
#pragma once

#ifdef __AVX512F__
#define HWY_WANT_AVX3_DL  // Highway 1.0.3 does not compile for such a processor alone without it
#endif

#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
