// Hair of a face that is moved otherwise than in its own clip.
#pragma once

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs {

/// A map is learned from what moved: hair about a head that hardly did may belong to the ground for all that
/// could be seen. The points next to the face, which cannot be anything else, are made to go with the head.
/// Those farther out stay as they are: there the map knows more than a prior does.
/// @param rest  state in which the map's picture was seen
[[nodiscard]] SurroundMap with_hair(SurroundMap map, const VideoFormat& format, const State& rest);

}  // namespace fbs
