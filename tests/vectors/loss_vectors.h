// A live stream of independent packets, each of which is lost, late or doubled.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

void add_losses(Folder& folder);

}  // namespace fbs
