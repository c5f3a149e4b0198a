// Streams whose pictures are blended from several patterns.
#pragma once

#include "tests/vectors/vector_tools.h"

namespace fbs {

/// Blends from a store of three slots, with every mode in every region: blends.fbs.
std::vector<Piece> hand_made_blends();

void add_blends(Folder& folder);

/// @param talk  a scene of one pattern
void add_broken_blends(Folder& folder, const Bytes& talk);

}  // namespace fbs
