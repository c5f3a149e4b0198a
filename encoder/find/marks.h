// Reference points on the first picture, to which the wire-frame is adapted. Paper section 2.1, Fig. 3 (b).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "common/generic_head.h"
#include "common/result.h"

namespace fbs {

/// Positions of the generic head's vertices in a picture, pixels (the first pixel's centre is 0.5, 0.5). Not
/// all need a mark, but both eyes (any lid point or corner of each) must have one.
struct Marks {
  std::array<std::optional<glm::dvec2>, kVertexCount> vertex;

  [[nodiscard]] std::optional<glm::dvec2> landmark(int ibug) const;
  void set_landmark(int ibug, glm::dvec2 p);

  /// Centres of the subject's right and left eye: the mean of the lid points and corners that are marked.
  [[nodiscard]] std::optional<std::array<glm::dvec2, 2>> eyes() const;
};

/// Reads marks from JSON: {"nose_tip": [x, y], ...} with the names of the mesh's vertices, or
/// {"landmarks": [[x, y] x 68]} in iBUG-68 order. Unknown names are an error.
[[nodiscard]] Result<Marks> read_marks(const std::string& path);

}  // namespace fbs
