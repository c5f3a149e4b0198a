#include "decoder/scene/scene.h"

#include <utility>

namespace fbs {

void Scene::set_geometry(SceneGeometry replacement) {
  geometry.emplace(std::move(replacement));
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    Pattern pattern = patterns[k];
    pattern.set_geometry(*geometry);
    patterns.replace(k, std::move(pattern));
  }
}

}  // namespace fbs
