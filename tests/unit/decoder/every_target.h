// Kernels tested on every kind of vector that this machine has.
#pragma once

#include "decoder/vectors/fixed_vectors.h"
// Before Highway, as in the kernels: otherwise there would be targets here that they lack.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <functional>

namespace fbs {

/// @param target  Highway's number; 0: the best available
inline void choose_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Calls check() with each kind of vector chosen in turn.
inline void on_every_target(const std::function<void()>& check) {
  int checked = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    choose_target(target);
    SCOPED_TRACE(hwy::TargetName(target));
    check();
    ++checked;
  }
  choose_target(0);
  EXPECT_GT(checked, 0);
}

}  // namespace fbs
