#include "encoder/model/skinning.h"

#include "decoder/head/mouth_interior.h"

namespace fbs {

HeadVertices skinned(const Geometry& geometry, const Offsets& offsets) {
  HeadVertices out;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    glm::dvec2 d(0);
    for (const SkinningWeight& skinning : skinning_of(v))
      d += static_cast<double>(skinning.weight) * offsets[skinning.control];
    out[v] = glm::dvec3(geometry.positions[v]) + glm::dvec3(d / static_cast<double>(kSkinningOne), 0);
  }
  return out;
}

std::int32_t mouth_gap(const HeadVertices& vertices) {
  const auto y_of = [&](std::size_t landmark) {
    return static_cast<std::int32_t>(vertices[vertex_of_landmark(landmark)].y);
  };
  return y_of(66) - y_of(62);
}

}  // namespace fbs
