#include "decoder/scene.h"

#include <utility>

#include "decoder/contrast_map.h"

namespace fbs {

Pattern make_pattern(Picture picture, const State& seen, const std::optional<SceneGeometry>& geometry) {
  return {std::move(picture), seen, geometry ? geometry->texture_mesh(seen) : TextureMesh{}};
}

Pattern make_coded_pattern(Picture coded, const State& seen, const std::optional<SceneGeometry>& geometry,
                           const Setup& setup) {
  Pattern out = make_pattern(std::move(coded), seen, geometry);
  if (geometry && ContrastMap::is_needed(setup)) ContrastMap(setup, out.texture).expand(out.picture);
  return out;
}

void Scene::set_geometry(SceneGeometry replacement) {
  geometry.emplace(std::move(replacement));
  for (Pattern& p : patterns) p.texture = geometry->texture_mesh(p.seen);
}

}  // namespace fbs
