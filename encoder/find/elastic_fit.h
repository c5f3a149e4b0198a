// The elastic process that brings a scaled wire-frame to its marks. Paper section 2.1, Fig. 3 (d).
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/wire_frame.h"

namespace fbs {

/// Position of each vertex, seen from the front, eye distances.
using FrontPoints = std::vector<glm::dvec2>;
using FrontMarks = std::vector<std::optional<glm::dvec2>>;

/// Depth of each vertex, away from the viewer, eye distances.
using Depths = std::vector<double>;
using DepthMarks = std::vector<std::optional<double>>;

struct ElasticFit {
  FrontPoints points;
  int iterations = 0;
};

/// Marks attract their vertices, and each force spreads over the mesh with a Gaussian of the edge distance
/// that narrows from iteration to iteration (Burr 1981, Reinders et al. 1992, as the paper cites them). An
/// iteration that would turn a triangle over is shortened until it does not.
/// @param distances  edge_distances() of the frame
[[nodiscard]] ElasticFit fit_elastically(const WireFrame& frame, std::span<const float> distances,
                                         const FrontPoints& scaled, const FrontMarks& target);

/// The same for depth, where no triangle can fold.
[[nodiscard]] Depths fit_elastically(std::span<const float> distances, const Depths& scaled,
                                     const DepthMarks& target);

}  // namespace fbs
