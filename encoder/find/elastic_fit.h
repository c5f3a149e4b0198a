// The elastic process that brings the scaled head to its marks. Paper section 2.1, Fig. 3 (d).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>

#include "common/generic_head.h"

namespace fbs {

/// Of each vertex, seen from the front, eye distances.
using FrontPoints = std::array<glm::dvec2, kVertexCount>;
using FrontMarks = std::array<std::optional<glm::dvec2>, kVertexCount>;

struct ElasticFit {
  FrontPoints points;
  int iterations = 0;
};

/// Marks attract their vertices, and each force spreads over the mesh with a Gaussian of the edge distance
/// that narrows from iteration to iteration (Burr 1981, Reinders et al. 1992, as the paper cites them). An
/// iteration that would turn a triangle over is shortened until it does not.
[[nodiscard]] ElasticFit fit_elastically(const FrontPoints& scaled, const FrontMarks& target);

}  // namespace fbs
