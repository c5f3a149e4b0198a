// The scenes of a stream, found without decoding: places where it can be joined. SPEC 6.1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"

namespace fbs {

struct SceneEntry {
  StreamPosition before;     ///< position of its first picture
  std::uint64_t offset = 0;  ///< of its setup packet, bytes from the start of the stream
  std::uint64_t bytes = 0;   ///< up to the next scene, the end packet or the end
  bool face = false;         ///< it has a geometry packet, and not of a plane
};

/// Reads packets and skips damage. Leaves out scenes without a valid setup packet, and scenes that begin
/// before an earlier one: no decoder shows them.
/// @param stream  from its signature on
/// @return in stream order, which is also the order of positions; empty if there is none
[[nodiscard]] std::vector<SceneEntry> index_scenes(std::span<const std::uint8_t> stream);

/// Where to start feeding a decoder, after kSignature, to show the picture of a time: the caller drops
/// earlier pictures.
/// @param time  1/90000 s
/// @return the last scene that begins at or before `time`, or the first if all begin later; null without
/// scenes
[[nodiscard]] const SceneEntry* scene_at(std::span<const SceneEntry> scenes, std::uint64_t time);

}  // namespace fbs
