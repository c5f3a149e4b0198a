// The scenes of a stream, found without decoding, and places where it can be joined. SPEC 6.1, 6.6.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"

namespace fbs {

/// A scene, or what comes behind a return to one.
struct SceneEntry {
  StreamPosition before;     ///< position of its first picture
  std::uint64_t offset = 0;  ///< of its setup or return packet, bytes from the start of the stream
  std::uint64_t bytes = 0;   ///< up to the next entry, the end packet or the end
  bool face = false;         ///< the scene has a geometry packet, and not of a plane
  bool is_return = false;    ///< it goes on with a scene before
  bool is_joinable = false;  ///< it begins a scene that needs none before
};

/// Reads packets and skips damage. Leaves out those without a valid setup or return packet, and those that
/// begin before an earlier one: no decoder shows them.
/// @param stream  from its signature on
/// @return in stream order, which is also the order of positions; empty if there is none
[[nodiscard]] std::vector<SceneEntry> index_scenes(std::span<const std::uint8_t> stream);

/// Where to start feeding a decoder, after kSignature, to show the picture of a time: the caller drops
/// earlier pictures.
/// @param time  1/90000 s
/// @return the last joinable scene that begins at or before `time`, or the first if all begin later; null
/// without joinable scenes
[[nodiscard]] const SceneEntry* scene_at(std::span<const SceneEntry> scenes, std::uint64_t time);

}  // namespace fbs
