#include "decoder/draw/renderer.h"

#include <algorithm>

#include "decoder/blend/mesh_blend.h"
#include "decoder/draw/head_painter.h"
#include "decoder/draw/mouth_painter.h"
#include "decoder/draw/silhouette.h"
#include "decoder/draw/surround_painter.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

std::array<ConstPlaneView, 3> planes_of(const Picture& picture) {
  return {picture.y, picture.u, picture.v};
}

bool same_size(const ConstPlaneView& a, const ConstPlaneView& b) {
  return a.width == b.width && a.height == b.height;
}

Error another_size() {
  return {ErrorCode::kInvalidArgument, "the picture to draw into has another size than the scene"};
}

SampleArea whole(const PlaneView& plane) {
  return {0, 0, plane.width, plane.height};
}

bool fits(const Pattern& pattern, const SceneGeometry& geometry) {
  const TextureMesh& texture = pattern.texture;
  const std::size_t points =
      geometry.surround().point_count() + (geometry.is_plane() ? geometry.head_mesh().vertex_count : 0);
  if (texture.head.size() != geometry.head_mesh().vertex_count ||
      texture.areas.size() != texture.head.size() || texture.surround.size() != points || !pattern.padded)
    return false;
  if (geometry.is_plane()) return true;
  const AtlasLayout& layout = geometry.atlas_layout();
  return pattern.atlas.width() == layout.width && pattern.atlas.height() == layout.height;
}

Result<void> check(const Scene& scene) {
  if (scene.patterns.empty()) return fail(ErrorCode::kInvalidArgument, "the scene has no pattern yet");
  for (const Pattern& p : scene.patterns) {
    if (scene.geometry && !fits(p, *scene.geometry))
      return fail(ErrorCode::kInvalidArgument, "a pattern's texture mesh is not of the scene's geometry");
    if (p.picture.width() != scene.patterns.front().picture.width() ||
        p.picture.height() != scene.patterns.front().picture.height())
      return fail(ErrorCode::kInvalidArgument, "patterns of different sizes");
  }
  return {};
}

PictureBlend blend_of_state(const Scene& scene, const State& state) {
  std::vector<const State*> seen;
  for (const Pattern& p : scene.patterns) seen.push_back(&p.seen);
  return blend_picture(seen, state);
}

/// Resizes the picture to the scene's size.
void fit(Picture& out, const Scene& scene) {
  const Picture& pattern = scene.patterns.front().picture;
  if (out.width() != pattern.width() || out.height() != pattern.height())
    out = Picture(pattern.width(), pattern.height());
}

MeshBlend on_mesh(const PictureBlend& regions, const Scene& scene, const ScreenMesh& mesh) {
  std::vector<const TextureMesh*> textures;
  for (const Pattern& p : scene.patterns) textures.push_back(&p.texture);
  return scene.geometry ? blend_mesh(regions, *scene.geometry, textures, mesh) : blend_regions(regions);
}

std::vector<DrawnSource> sources_of(const Scene& scene, const MeshBlend& blend) {
  std::vector<DrawnSource> out;
  for (const BlendSource& s : blend.sources) {
    const Pattern& pattern = scene.patterns[s.pattern];
    if (s.still || !scene.geometry)
      out.push_back({planes_of(pattern.picture)});
    else
      out.push_back({planes_of(pattern.picture), &pattern.texture, &*pattern.padded,
                     pattern.atlas.empty() ? nullptr : &pattern.atlas});
  }
  return out;
}

}  // namespace

Result<void> Renderer::render(const Scene& scene, const State& state, const PictureView& out) {
  if (auto checked = check(scene); !checked) return checked;
  const auto first = planes_of(scene.patterns.front().picture);
  const Targets targets = {out.y, out.u, out.v};
  if (!std::equal(first.begin(), first.end(), targets.begin(), same_size)) return fail(another_size());
  draw(scene, state, blend_of_state(scene, state), targets, whole(out.y), whole(out.u));
  return {};
}

Result<void> Renderer::render_from(std::size_t pattern, const Scene& scene, const State& state,
                                   Picture& out) {
  if (auto checked = check(scene); !checked) return checked;
  if (pattern >= scene.patterns.size())
    return fail(ErrorCode::kInvalidArgument, "the scene has no pattern of that number");
  fit(out, scene);
  PictureBlend alone;
  alone.fill({{{static_cast<std::uint8_t>(pattern), false}, kBlendOne}});
  draw(scene, state, alone, {out.y, out.u, out.v}, whole(out.y), whole(out.u));
  return {};
}

Result<void> Renderer::render_luma(const Scene& scene, const State& state, const SampleArea& area,
                                   const PlaneView& out) {
  if (auto checked = check(scene); !checked) return checked;
  if (!same_size(scene.patterns.front().picture.y, out)) return fail(another_size());
  const SampleArea inside = intersection({area.x0 - kSilhouetteReach, area.y0 - kSilhouetteReach,
                                          area.x1 + kSilhouetteReach, area.y1 + kSilhouetteReach},
                                         whole(out));
  if (!area.empty() && !inside.empty())
    draw(scene, state, blend_of_state(scene, state), {out, {}, {}}, inside, {});
  return {};
}

void Renderer::draw(const Scene& scene, const State& state, const PictureBlend& regions,
                    const Targets& targets, const SampleArea& luma, const SampleArea& chroma) {
  const ScreenMesh mesh = scene.geometry ? scene.geometry->screen_mesh(state) : ScreenMesh{};
  const MeshBlend blend = on_mesh(regions, scene, mesh);
  const Drawing drawing{
      mesh, blend, sources_of(scene, blend), interior_colours(scene.setup.mouth, mesh.interior), targets,
      luma, chroma};
  const Picture& size = scene.patterns.front().picture;
  const NodeGrid grid(size.width(), size.height());
  find_nodes(scene, grid, drawing);
  SurroundDrawing surround{drawing, grid, field_, weights_};
  if (!scene.geometry || scene.geometry->is_plane()) return surround_.draw(surround);
  const WireFrame& wire_frame = scene.geometry->geometry().wire_frame();
  const AtlasLayout& layout = scene.geometry->atlas_layout();
  const HeadWeights weights = head_weights(drawing.blend, wire_frame);
  atlas_.draw(drawing, weights, layout);
  // The head first: what it covers of the surround is not drawn.
  HeadPainter head(drawing, *scene.geometry, weights, raster_);
  head.draw(atlas_.planes());
  surround.head = {&raster_[0].depth(), chroma.empty() ? nullptr : &raster_[1].depth()};
  surround_.draw(surround);
  for (const PlaneScale scale : {PlaneScale::kLuma, PlaneScale::kChroma}) {
    if (drawing.area(scale).empty()) continue;
    head.soften(scale);
    draw_mouth(drawing, wire_frame, scale);
  }
}

void Renderer::find_nodes(const Scene& scene, const NodeGrid& grid, const Drawing& drawing) {
  const std::vector<std::int32_t>& ground = drawing.blend.regions[static_cast<std::size_t>(Region::kGround)];
  if (scene.geometry) {
    const SceneGeometry& geometry = *scene.geometry;
    const std::vector<glm::ivec2>& now = drawing.mesh.surround;
    cover_.find(grid, geometry.surround_triangles(), now);
    PointWeights corners = point_weights(drawing.blend.regions, geometry.surround().shares());
    if (geometry.is_plane()) {
      const std::vector<std::int32_t>& head = drawing.blend.head.weights;
      corners.weights.insert(corners.weights.end(), head.begin(), head.end());
    }
    weights_.set(cover_, corners, ground);
    seen_.clear();
    for (const DrawnSource& source : drawing.sources)
      seen_.push_back(source.texture == nullptr ? nullptr : &source.texture->surround);
    const Picture& size = scene.patterns.front().picture;
    field_.set(cover_, seen_, now, {size.width(), size.height()});
  } else {
    weights_.set(grid, ground);
    field_.set_still();
  }
}

Result<void> Renderer::render(const Scene& scene, const State& state, Picture& out) {
  if (auto checked = check(scene); !checked) return checked;
  fit(out, scene);
  return render(scene, state, PictureView(out));
}

}  // namespace fbs
