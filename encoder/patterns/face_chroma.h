// Measures how far a face's chroma is from grey, to choose its contrast before coding.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "bitstream/syntax.h"
#include "common/picture.h"

namespace fbs {

/// Against no extra contrast, this gains 1.1 to 2.9 dB in the chroma of the face (four clips at quality 50,
/// 0.6 % of the rate at equal luma); twice the contrast gains another 0.8 dB, and takes 1 % more where
/// pictures are large.
inline constexpr std::int32_t kWantedChromaContrast = kContrastOne * 3 / 2;

/// A histogram over the pictures so far.
class FaceChroma {
 public:
  /// Adds the box around the head.
  /// @param vertices  screen positions of the head's vertices, 1/64 pixel
  void add(const Picture& picture, std::span<const glm::ivec3> vertices);

  /// Setup::chroma_contrast: the wanted contrast, or the largest with which hardly a sample leaves 0..255;
  /// kContrastOne when nothing has been added.
  [[nodiscard]] std::int32_t contrast() const;

 private:
  void add(const Plane& plane, int x0, int y0, int x1, int y1);

  std::array<std::int64_t, 129> count_{};  ///< samples, by distance from grey
};

}  // namespace fbs
