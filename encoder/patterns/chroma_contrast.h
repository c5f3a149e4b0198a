// Measures how far a scene's chroma is from grey, to choose the contrast with which patterns are coded.
#pragma once

#include <array>
#include <cstdint>

#include "common/picture.h"

namespace fbs {

/// A histogram over the pictures so far.
class ChromaContrast {
 public:
  /// @param most  contrast that is wanted
  explicit ChromaContrast(std::int32_t most) : most_(most) {}

  void add(const Picture& picture);

  /// Setup::chroma_contrast: as much as is wanted, or the largest with which hardly a sample leaves 0..255;
  /// kContrastOne when nothing has been added.
  [[nodiscard]] std::int32_t contrast() const;

 private:
  std::int32_t most_;
  std::array<std::int64_t, 129> count_{};  ///< samples, by distance from grey
};

}  // namespace fbs
