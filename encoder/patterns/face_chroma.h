// How far the chroma of a face is from grey, and so by how much its contrast can be raised before coding.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "bitstream/syntax.h"
#include "common/picture.h"

namespace fbs {

/// Chroma of the face gains 1.1 to 2.9 dB over none (four clips at quality 50, 0.6 % of the rate at equal
/// luma); twice the contrast gains another 0.8 dB, and takes 1 % more where pictures are large.
inline constexpr std::int32_t kWantedChromaContrast = kContrastOne * 3 / 2;

/// A histogram over the pictures seen so far.
class FaceChroma {
 public:
  /// Adds the box round the head.
  /// @param vertices  screen positions of the head's vertices, 1/64 pixel
  void add(const Picture& picture, std::span<const glm::ivec3> vertices);

  /// Setup::chroma_contrast: what is wanted, or the most with which hardly a sample leaves 0..255;
  /// kContrastOne when nothing has been added.
  [[nodiscard]] std::int32_t contrast() const;

 private:
  void add(const Plane& plane, int x0, int y0, int x1, int y1);

  std::array<std::int64_t, 129> count_{};  ///< of samples, by distance from grey
};

}  // namespace fbs
