#include "decoder/scene.h"

#include <utility>

namespace fbs {

Pattern make_pattern(Picture picture, const State& seen, const std::optional<SceneGeometry>& geometry) {
  return {std::move(picture), seen, geometry ? geometry->texture_mesh(seen) : TextureMesh{}};
}

void Scene::set_geometry(SceneGeometry replacement) {
  geometry.emplace(std::move(replacement));
  for (Pattern& p : patterns) p.texture = geometry->texture_mesh(p.seen);
}

}  // namespace fbs
