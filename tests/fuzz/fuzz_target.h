// The interface of every fuzz target, so that one program can replay them all without a fuzzing engine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace fbs::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Inputs of this target, taken from a stream: itself, payloads of its packets, its frames.
std::vector<Bytes> seeds_of(const Bytes& stream);

}  // namespace fbs::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Aborts when an input breaks what must always hold: a finding.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz target: %s\n", what);
  std::abort();
}
