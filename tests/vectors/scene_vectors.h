// Vectors of several scenes.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

/// @return late.fbs, of two scenes
Bytes add_scenes(Folder& folder);
void add_broken_scenes(Folder& folder);

}  // namespace fbs
