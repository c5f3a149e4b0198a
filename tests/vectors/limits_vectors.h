// Streams of states at and between all limits, which no encoder writes.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

void add_limits(Folder& folder);

}  // namespace fbs
