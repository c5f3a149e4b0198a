// Streams with a wire-frame of their own.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

/// @param talk  a scene of one pattern
void add_wire_frames(Folder& folder, const Bytes& talk);
void add_broken_wire_frames(Folder& folder, const Bytes& talk);

}  // namespace fbs
