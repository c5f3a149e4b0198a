// Patterns are coded with less contrast outside the face, so that a given error costs more bits inside it,
// and with more contrast in chroma: AV1 without a quantiser map or offset. SPEC 11.7. Integers only.
#pragma once

#include <cstdint>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "common/state.h"

namespace fbs {

/// The contrast of each sample of a coded pattern: of luma by share of the face, of chroma everywhere the
/// same.
class ContrastMap {
 public:
  /// Whether patterns are coded with a contrast other than one.
  [[nodiscard]] static bool is_needed(const Setup& setup) {
    return setup.contrast != kContrastOne || setup.chroma_contrast != kContrastOne;
  }

  /// @param setup  its picture size and contrasts
  /// @param head   luma's contrast changes over a wide band along its outline in the pattern, since a step
  ///               would leave a line where AV1 has smoothed it
  /// @param seen   the pattern's state
  ContrastMap(const Setup& setup, const Geometry& head, const State& seen);

  /// Converts a coded pattern to the picture it shows.
  void expand(Picture& picture) const;

  /// Converts a picture to the coded pattern.
  void reduce(Picture& picture) const;

 private:
  Plane cells_;  ///< share of the face in blocks of 4 x 4 luma samples, 0..255
  std::int32_t surround_, chroma_;
};

}  // namespace fbs
