// Kernels without vectors, for tools that do not know all instructions of the processor, such as valgrind.
#pragma once

namespace fbs {

/// Whether the environment variable FBS_CPU is "scalar". Read when the library is loaded.
#ifdef __EMSCRIPTEN__
inline constexpr bool kScalarOnly = false;  // pages have no environment
#else
extern const bool kScalarOnly;
#endif

/// The vectors that kernels use, such as "AVX2", or "scalar".
[[nodiscard]] const char* kernel_name();

}  // namespace fbs

/// The best function for the processor, of those that HWY_EXPORT(kernel) lists, or its plain counterpart.
#define FBS_DISPATCH(kernel, plain) (fbs::kScalarOnly ? (plain) : HWY_DYNAMIC_DISPATCH(kernel))
