// Colour of the mouth interior: means over the open mouths so far.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "bitstream/syntax.h"
#include "common/picture.h"

namespace fbs {

/// Chroma only: luma is part of the state (State::interior), relative to the luma in the setup.
class MouthColours {
 public:
  /// @param rest_height  mouth_height() in the pattern
  /// @param eye_distance_px  of the head in it
  MouthColours(std::int32_t rest_height, double eye_distance_px)
      : rest_height_(rest_height), eye_distance_px_(eye_distance_px) {}

  /// Adds the colours between parted lips in a picture: the darkest place on the mouth's midline, and the
  /// place half way from there to the upper inner lip, where teeth are. The outer lips decide whether the
  /// mouth is open: inner lips are tracked less reliably.
  /// @param vertices  screen positions of the head's vertices, 1/64 pixel
  void add(const Picture& picture, std::span<const glm::ivec3> vertices);

  /// Sets the chroma of either lip's colour once it has been seen often enough.
  void set_chroma(MouthInterior& mouth) const;

 private:
  struct Sum {
    std::int64_t u = 0, v = 0, count = 0;
    void add(const Picture& picture, glm::dvec2 at);
    void set_chroma(YuvColour& colour) const;
  };
  std::int32_t rest_height_;
  double eye_distance_px_;
  Sum upper_, lower_;
};

/// Distance between the outer lips' middles, 1/64 pixel.
[[nodiscard]] std::int32_t mouth_height(std::span<const glm::ivec3> vertices);

}  // namespace fbs
