// Small changes of bytes that ignore their meaning.
#pragma once

#include <random>

#include "tests/fuzz/fuzz_target.h"

namespace fbs::fuzz {

using Random = std::mt19937;

/// Changes some bytes: flips bits, inserts, erases, copies, rarely truncates. Empty input stays empty.
void mutate_bytes(Bytes& bytes, Random& random);

}  // namespace fbs::fuzz
