// Patterns are coded with less contrast outside the face, so that a given error there costs more bits than in
// it, and with more contrast of the face's chroma: AV1 without a quantiser map. SPEC 11.7. Integers only.
#pragma once

#include <cstdint>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "decoder/animate/screen_mesh.h"
#include "decoder/head/head_mesh.h"

namespace fbs {

/// The contrast of each sample of a pattern as it is coded.
class ContrastMap {
 public:
  /// Whether patterns are coded otherwise than they are shown.
  [[nodiscard]] static bool is_needed(const Setup& setup) {
    return setup.contrast != kContrastOne || setup.chroma_contrast != kContrastOne;
  }

  /// @param setup    its picture size and contrasts
  /// @param texture  of the pattern: the face's contrast inside its outline, the surround's from the ring
  ///                 outwards, linear between
  ContrastMap(const Setup& setup, const HeadMesh& head, const TextureMesh& texture);

  /// From a pattern as it is coded to what it shows.
  void expand(Picture& picture) const;

  /// From what a pattern shows to what is coded.
  void reduce(Picture& picture) const;

 private:
  Plane luma_, chroma_;                  ///< share of the face, 0..255
  std::int32_t surround_, face_chroma_;  ///< contrasts; that of the face's luma is full
};

}  // namespace fbs
