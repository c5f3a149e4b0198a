// Vectors with sound.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

/// Writes them, and sound.txt.
/// @param talk  a stream of one scene; it shares its pictures with the vectors of one scene
/// @param late  one of two
void add_sound(Folder& folder, const std::string& path, const Bytes& talk, const Bytes& late);

}  // namespace fbs
