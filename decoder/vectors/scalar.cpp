#include "decoder/vectors/scalar.h"

#include "decoder/vectors/fixed_vectors.h"
// Behind it, as in the kernels.
#include <hwy/targets.h>

#include <cstdlib>
#include <string_view>

namespace fbs {
#ifndef __EMSCRIPTEN__
namespace {

bool asks_for_scalar() {
  const char* const wanted =
      std::getenv("FBS_CPU");  // NOLINT(concurrency-mt-unsafe): before any thread of ours
  return wanted != nullptr && std::string_view(wanted) == "scalar";
}

}  // namespace

const bool kScalarOnly = asks_for_scalar();
#endif

const char* kernel_name() {
  const auto usable = HWY_SUPPORTED_TARGETS & HWY_TARGETS;
  return kScalarOnly ? "scalar" : hwy::TargetName(usable & -usable);  // the best has the lowest bit
}

}  // namespace fbs
