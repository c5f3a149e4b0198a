// Marks of the brows.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "encoder/find/face_yaw.h"
#include "encoder/find/landmarks.h"

namespace fbs {

/// The brow's landmarks, on its upper border; eye distances.
/// @param first  landmark: ibug::kBrowRight or kBrowLeft
[[nodiscard]] std::array<glm::dvec2, ibug::kBrowPoints> find_brow(const FaceFrame& face, const FaceYaw& yaw,
                                                                  int first);

}  // namespace fbs
