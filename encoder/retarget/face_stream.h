// The still part of a face in a stream: geometry and patterns, without its motion.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"
#include "common/state.h"

namespace fbs {

struct FaceStream {
  struct LaterPattern {
    State seen;
    std::vector<std::uint8_t> av1;
  };
  Setup setup;
  Geometry geometry;
  std::vector<std::uint8_t> wire_frame_payload;  ///< empty: the generic head
  std::vector<std::uint8_t> geometry_payload;
  std::optional<SurroundMap> surround;  ///< the last one of the scene
  PatternSyntax first;
  State rest;                       ///< in which the first pattern was seen
  std::vector<LaterPattern> later;  ///< in coding order, in slots 1, 2, ...; at most kMaxPatterns - 1
  std::array<double, kInteriorCount>
      interior{};  ///< light of the open mouth, mean over its pictures, 1/16 level
};

/// Reads the first scene with a face. Keeps the patterns that fill the store; later replacements are left
/// out.
/// @param stream  the whole of it
/// @return errors of PacketReader and of the payloads, with the byte offset; kDegenerateInput when no scene
/// has a face
[[nodiscard]] Result<FaceStream> read_face_stream(std::span<const std::uint8_t> stream);

}  // namespace fbs
