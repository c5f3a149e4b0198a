// What every fuzz target has, so that one program can replay them all without a fuzzing engine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

/// Packets whose payloads make good seeds for this target; 0: whole streams.
extern const std::uint8_t kSeedPacket;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// A finding: what the input must never be able to do.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz target: %s\n", what);
  std::abort();
}
