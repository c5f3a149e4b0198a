#include "decoder/scene/pattern.h"

#include <algorithm>
#include <utility>

#include "decoder/pattern/contrast_map.h"

namespace fbs {

void Pattern::set_geometry(const SceneGeometry& geometry) {
  texture = geometry.texture_mesh(seen);
  if (picture.y.samples.empty()) return;  // an encoder may know the state before the picture
  if (!padded) padded.emplace(fbs::padded(picture));
  if (!geometry.is_plane())
    draw_atlas(geometry.atlas_layout(), {picture.y, picture.u, picture.v}, texture.head, texture.light,
               atlas);
}

Pattern make_pattern(Picture picture, const State& seen, const std::optional<SceneGeometry>& geometry) {
  Pattern out{0, std::move(picture), seen, {}, {}, {}};
  if (geometry) out.set_geometry(*geometry);
  return out;
}

Pattern make_coded_pattern(Picture coded, const State& seen, const std::optional<SceneGeometry>& geometry,
                           const Setup& setup) {
  if (geometry && ContrastMap::is_needed(setup)) ContrastMap(setup, geometry->geometry(), seen).expand(coded);
  return make_pattern(std::move(coded), seen, geometry);
}

void PatternList::store(Pattern pattern) {
  const auto place = std::lower_bound(patterns_.begin(), patterns_.end(), pattern.slot,
                                      [](const Shared& p, std::int32_t slot) { return p->slot < slot; });
  if (place != patterns_.end() && (*place)->slot == pattern.slot)
    *place = shared(std::move(pattern));
  else
    patterns_.insert(place, shared(std::move(pattern)));
}

}  // namespace fbs
