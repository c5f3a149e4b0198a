// How a recorded head looks: the part of its pattern that its model shows, and the inside of its mouth.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "decoder/export/head_recording.h"

namespace fbs {

/// Samples of a pattern.
struct TextureArea {
  int left = 0, top = 0;
  int width = 0, height = 0;  ///< at least 1
};

using Srgb = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// What only a program that knows image files can make.
struct HeadLook {
  std::vector<std::uint8_t> png;             ///< of texture_area()
  std::array<Srgb, kInteriorCount> mouth{};  ///< mouth_colours()
};

/// Colours between parted lips at the upper lip, half way and at the lower lip: the decoder's own, with the
/// light that the recording adds to them on average, where the mouth is open.
[[nodiscard]] std::array<YuvColour, kInteriorCount> mouth_colours(const RecordedHead& head);

/// The face in the pattern and a margin for filters. It lies in the picture.
[[nodiscard]] TextureArea texture_area(const RecordedHead& head);

/// Where the vertices lie in the area, 0..1 from its upper left corner: the projected vertices of the
/// pattern.
[[nodiscard]] std::vector<glm::dvec2> texture_coordinates(const RecordedHead& head, const TextureArea& area);

/// Whether the pattern itself shows the inside of the mouth, by as much as makes the decoder's own interior
/// opaque. Otherwise the triangles between the lips have no area in it.
[[nodiscard]] bool pattern_shows_mouth(const RecordedHead& head);

/// Triangles of the model, counter-clockwise seen from the front.
struct HeadTriangles {
  std::vector<std::uint16_t> face;   ///< three corners each
  std::vector<std::uint16_t> mouth;  ///< between the inner lips; empty if the face has them
};
[[nodiscard]] HeadTriangles head_triangles(const RecordedHead& head);

}  // namespace fbs
