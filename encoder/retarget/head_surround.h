// Hair of a face whose motion is not its own.
#pragma once

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs {

/// A map is learned from motion: around a head that hardly moved, hair may seem to belong to the ground. The
/// points next to the face, which must be hair, are made to follow the head. Points farther out stay
/// unchanged: there the map knows more than a prior does.
/// @param rest  state in which the map's picture was seen
[[nodiscard]] SurroundMap with_hair(SurroundMap map, const VideoFormat& format, const State& rest);

}  // namespace fbs
