// What shows between the lips: mean colours of open mouths seen so far.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "bitstream/syntax.h"
#include "common/picture.h"

namespace fbs {

class MouthColours {
 public:
  /// Adds what a picture shows between parted lips: the darkest place on the mouth's middle line, and what
  /// lies half way from there to the upper inner lip, where teeth are. Only the outer lips are trusted to say
  /// that the mouth is open.
  /// @param vertices  where the head's vertices are seen, 1/64 pixel
  /// @param rest_height  between the outer lips' middles in the pattern, 1/64 pixel
  /// @param eye_distance_px  of the head as it is seen
  void add(const Picture& picture, const std::array<glm::ivec3, kVertexCount>& vertices,
           std::int32_t rest_height, double eye_distance_px);

  /// Means at the upper and at the lower lip; MouthInterior's defaults until enough has been seen.
  [[nodiscard]] MouthInterior colours() const;

 private:
  struct Sum {
    std::array<std::int64_t, 3> yuv{};
    std::int64_t count = 0;
    void add(const Picture& picture, glm::dvec2 at);
  };
  Sum upper_, lower_;
};

/// Distance of the outer lips' middles, 1/64 pixel.
[[nodiscard]] std::int32_t mouth_height(const std::array<glm::ivec3, kVertexCount>& vertices);

}  // namespace fbs
