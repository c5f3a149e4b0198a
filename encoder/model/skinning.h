// The head moved by its control points: deform() of the decoder in continuous numbers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "bitstream/syntax.h"
#include "encoder/model/expression_basis.h"

namespace fbs {

using HeadVertices = std::array<glm::dvec3, kVertexCount>;  ///< head frame, head units

/// Differs from deform(): a pupil may leave the eye when the lids shut. Keeping it between them as there, but
/// without derivatives by the lids, cost 3 % of the motion's rate and 0.03 dB in the face.
/// @param geometry  the adapted, expressionless head
[[nodiscard]] HeadVertices skinned(const Geometry& geometry, const Offsets& offsets);

/// Distance of the middles of the inner lips, in whole head units as for interior_opacity().
[[nodiscard]] std::int32_t mouth_gap(const HeadVertices& vertices);

}  // namespace fbs
