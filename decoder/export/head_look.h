// The look of a recorded head: the part of the pattern that its model shows, and the inside of its mouth.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "decoder/export/head_recording.h"

namespace fbs {

/// An area of a pattern, samples.
struct TextureArea {
  int left = 0, top = 0;
  int width = 0, height = 0;  ///< at least 1
};

using Srgb = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// The part of a look that needs a program that knows image files.
struct HeadLook {
  std::vector<std::uint8_t> png;             ///< of texture_area()
  std::array<Srgb, kInteriorCount> mouth{};  ///< mouth_colours()
};

/// Colours between parted lips at the upper lip, half way and at the lower lip: the decoder's own, plus the
/// light that the recording adds on average where the mouth is open.
[[nodiscard]] std::array<YuvColour, kInteriorCount> mouth_colours(const RecordedHead& head);

/// The face in the pattern, with a margin for filters; within the picture.
[[nodiscard]] TextureArea texture_area(const RecordedHead& head);

/// Texture coordinates of the vertices, 0..1 from the area's upper left corner: the vertices as projected in
/// the pattern.
[[nodiscard]] std::vector<glm::dvec2> texture_coordinates(const RecordedHead& head, const TextureArea& area);

/// Whether the pattern itself shows the inside of the mouth, parted far enough to make the decoder's own
/// interior opaque. Otherwise the triangles between the lips have no area in the texture.
[[nodiscard]] bool pattern_shows_mouth(const RecordedHead& head);

/// Triangles of the model, counter-clockwise seen from the front.
struct HeadTriangles {
  std::vector<std::uint16_t> face;   ///< three corners each
  std::vector<std::uint16_t> mouth;  ///< between the inner lips; empty if the face has them
};
[[nodiscard]] HeadTriangles head_triangles(const RecordedHead& head);

}  // namespace fbs
