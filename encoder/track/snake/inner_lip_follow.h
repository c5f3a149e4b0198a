// How far the inner lips follow the outer ones.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace fbs {

/// Share of each outer control point's displacement that each inner control point takes: [inner][outer], from
/// the generic head's skinning weights at the inner lips' vertices.
[[nodiscard]] const std::vector<std::vector<double>>& inner_lip_follow();

}  // namespace fbs
