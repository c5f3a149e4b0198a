// Vectors that return to earlier scenes.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

void add_returns(Folder& folder);

}  // namespace fbs
