// The interface of every fuzz target, so that one program can replay them all without a fuzzing engine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

/// Packets whose payloads make good seeds for this target; 0: whole streams.
extern const std::uint8_t kSeedPacket;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Aborts when an input breaks what must always hold: a finding.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz target: %s\n", what);
  std::abort();
}
