// Vectors of several scenes.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

void add_scenes(Folder& folder);
void add_broken_scenes(Folder& folder);

}  // namespace fbs
