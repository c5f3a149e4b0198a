// The head as a pattern shows it, drawn into the atlas once. SPEC 10.12. Integers only.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "common/picture.h"
#include "decoder/atlas/atlas_layout.h"
#include "decoder/head/face_light.h"

namespace fbs {

/// A picture of the layout's size; samples that no triangle covers are undefined.
using HeadAtlas = Picture;

/// Draws a pattern's head into an atlas, without its light.
/// @param planes     Y, U, V of the pattern
/// @param positions  of the HeadMesh's vertices in the pattern, 1/64 luma sample
/// @param light      on the vertices in the pattern; empty: none
void draw_atlas(const AtlasLayout& layout, const std::array<ConstPlaneView, 3>& planes,
                std::span<const glm::ivec2> positions, const std::vector<VertexLight>& light, HeadAtlas& out);

}  // namespace fbs
