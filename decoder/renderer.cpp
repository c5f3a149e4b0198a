#include "decoder/renderer.h"

#include <algorithm>
#include <optional>
#include <span>

#include "decoder/blend/mesh_blend.h"
#include "decoder/head/head_mesh.h"
#include "decoder/head/mouth_interior.h"
#include "decoder/raster/rasteriser.h"
#include "decoder/raster/blend_weights.h"

namespace fbs {
namespace {

static_assert(kMeshWeightOne == kWeightOne);
static_assert(kMaxTriangleSources == kRegionCount * kMaxRegionSources);

/// The planes of one scale: the patterns', the picture's, and the colours of the mouth interior in them.
struct Layer {
  PlaneScale scale;
  std::size_t first, count;  ///< planes of a picture: Y, U, V
  std::vector<std::vector<ConstPlaneView>> textures;  ///< of each source
  RasterTarget target;                                ///< all samples, without depth
  std::span<const InteriorColours> interior;
};

/// All that a picture is drawn from.
struct Drawing {
  const Scene& scene;
  const ScreenMesh& mesh;
  const MeshBlend& blend;
  [[nodiscard]] const Pattern& pattern(std::size_t source) const {
    return scene.patterns[blend.sources[source].pattern];
  }
};

std::array<ConstPlaneView, 3> planes_of(const Picture& picture) {
  return {picture.y, picture.u, picture.v};
}

ScreenTriangle on_screen(const HeadTriangle& triangle, const ScreenMesh& mesh) {
  ScreenTriangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::ivec3 p = mesh.head[triangle[i]];
    t[i] = {{p.x, p.y}, p.z};
  }
  return t;
}

/// Samples that the head can cover, within `limit`.
SampleArea area_of_head(const ScreenMesh& mesh, PlaneScale scale, const SampleArea& limit) {
  glm::ivec2 low(kMaxScreen), high(-kMaxScreen);
  for (const glm::ivec3& p : mesh.head) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const int bits = static_cast<int>(scale);
  return {std::clamp(low.x >> bits, limit.x0, limit.x1), std::clamp(low.y >> bits, limit.y0, limit.y1),
          std::clamp((high.x >> bits) + 1, limit.x0, limit.x1),
          std::clamp((high.y >> bits) + 1, limit.y0, limit.y1)};
}

/// Calls use(source, weights at the corners) for the sources that some corner has.
template <class Use>
void for_each_source(const PointWeights& weights, const std::array<int, 3>& corners, Use&& use) {
  const auto a = weights.at(corners[0]), b = weights.at(corners[1]), c = weights.at(corners[2]);
  for (std::size_t s = 0; s < weights.sources; ++s)
    if ((a[s] | b[s] | c[s]) != 0) use(s, std::array<std::int32_t, 3>{a[s], b[s], c[s]});
}

/// The sources of the triangle that is drawn, made anew for each.
struct SourceList {
  std::array<TextureSource, kMaxTriangleSources> sources;
  std::array<Light, kMaxTriangleSources> light;
  std::array<InteriorMix, kMaxTriangleSources> interior;
  std::size_t count = 0;
  [[nodiscard]] std::span<const TextureSource> all() const { return std::span(sources).first(count); }
};

/// Draws the cells of the surround's grid.
class SurroundPainter {
 public:
  SurroundPainter(const Drawing& drawing, std::span<const Layer> layers) : d_(drawing), layers_(layers) {}

  void draw(const Surround::Cell& cell) {
    if (is_ground_at_rest(cell)) return;
    draw_half({cell[0], cell[1], cell[2]});
    draw_half({cell[0], cell[2], cell[3]});
  }

 private:
  /// Whether the cell would look as the picture does before it is drawn.
  [[nodiscard]] bool is_ground_at_rest(const Surround::Cell& cell) const {
    return std::all_of(cell.begin(), cell.end(), [&](int k) {
      const auto weights = d_.blend.surround.at(k);
      if (!std::equal(weights.begin(), weights.end(), d_.blend.ground.begin())) return false;
      for (std::size_t s = 0; s < weights.size(); ++s)
        if (weights[s] != 0 && !d_.blend.sources[s].still &&
            d_.mesh.surround[k] != d_.pattern(s).texture.seen_surround[k])
          return false;
      return true;
    });
  }

  void draw_half(const std::array<int, 3>& corners) {
    const auto& at = d_.mesh.surround;
    const ScreenTriangle t = {{{at[corners[0]]}, {at[corners[1]]}, {at[corners[2]]}}};
    for (const Layer& layer : layers_) {
      list_.count = 0;
      for_each_source(d_.blend.surround, corners, [&](std::size_t s, const std::array<std::int32_t, 3>& weight) {
        const auto& in = d_.blend.sources[s].still ? at : d_.pattern(s).texture.surround;
        list_.sources[list_.count++] = {
            layer.textures[s], {in[corners[0]], in[corners[1]], in[corners[2]]}, {}, weight};
      });
      draw_triangle(t, list_.all(), layer.target);
    }
  }

  const Drawing& d_;
  std::span<const Layer> layers_;
  SourceList list_;
};

/// Draws the triangles of the head in one layer.
class HeadPainter {
 public:
  HeadPainter(const Drawing& drawing, const Layer& layer, DepthPlane& depth)
      : d_(drawing), layer_(layer), target_(layer.target) {
    target_.area = area_of_head(d_.mesh, layer.scale, target_.area);
    if (target_.area.empty()) return;
    depth.reset(target_.planes.front().width, target_.planes.front().height, target_.area);
    target_.depth = &depth;
  }

  void draw() {
    if (target_.area.empty()) return;
    for (const HeadTriangle& triangle : head_mesh().triangles) draw(triangle);
  }

 private:
  void draw(const HeadTriangle& triangle) {
    const bool is_interior = std::all_of(triangle.begin(), triangle.end(), is_inner_lip);
    list_.count = 0;
    for_each_source(d_.blend.head, {triangle[0], triangle[1], triangle[2]},
                    [&](std::size_t s, const std::array<std::int32_t, 3>& weight) {
                      add_source(s, triangle, is_interior, weight);
                    });
    draw_triangle(on_screen(triangle, d_.mesh), list_.all(), target_);
  }

  void add_source(std::size_t s, const HeadTriangle& triangle, bool is_interior,
                  const std::array<std::int32_t, 3>& weight) {
    const std::size_t n = list_.count++;
    TextureSource& source = list_.sources[n];
    source = {layer_.textures[s], {}, {}, weight};
    if (d_.blend.sources[s].still) {
      for (std::size_t i = 0; i < 3; ++i) source.corners[i] = d_.mesh.head[triangle[i]];
      return;
    }
    const TextureMesh& texture = d_.pattern(s).texture;
    for (std::size_t i = 0; i < 3; ++i) source.corners[i] = texture.head[triangle[i]];
    const bool lit = layer_.scale == PlaneScale::kLuma && !(d_.mesh.light.empty() && texture.light.empty());
    if (lit) {
      list_.light[n] = light_over(triangle, texture);
      source.finish.light = &list_.light[n];
    }
    const std::int32_t opacity = interior_opacity(d_.mesh.mouth_gap, texture.mouth_gap);
    if (is_interior && opacity > 0) {
      list_.interior[n] = {{}, opacity, layer_.interior};
      std::transform(triangle.begin(), triangle.end(), list_.interior[n].ramp.begin(), mouth_ramp);
      source.finish.interior = &list_.interior[n];
    }
  }

  /// The light that the picture has and the pattern has not.
  [[nodiscard]] Light light_over(const HeadTriangle& triangle, const TextureMesh& texture) const {
    const auto at = [](const std::vector<VertexLight>& light, std::size_t v) {
      return light.empty() ? VertexLight{} : light[v];
    };
    Light out;
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexLight now = at(d_.mesh.light, triangle[i]), seen = at(texture.light, triangle[i]);
      out.offset[i] = now.offset - seen.offset;
      out.gain[i] = now.gain - seen.gain;
    }
    return out;
  }

  const Drawing& d_;
  const Layer& layer_;
  RasterTarget target_;
  SourceList list_;
};

void copy(const ConstPlaneView& from, const PlaneView& to) {
  for (int y = 0; y < from.height; ++y) std::copy_n(from.row(y), from.width, to.row(y));
}

void add_scaled(const std::uint8_t* samples, std::int32_t weight, std::uint16_t* sum, int count) {
  const auto w = static_cast<std::uint16_t>(weight);
  for (int i = 0; i < count; ++i) sum[i] = static_cast<std::uint16_t>(sum[i] + samples[i] * w);
}

void round_sum(const std::uint16_t* sum, std::uint8_t* out, int count) {
  for (int i = 0; i < count; ++i) out[i] = static_cast<std::uint8_t>(sum[i] >> kCoarseOneLog2);
}

/// The patterns as they are, blended as the ground is.
void draw_base(const Drawing& d, std::span<const PlaneView> targets) {
  std::vector<std::size_t> used;
  for (std::size_t s = 0; s < d.blend.ground.size(); ++s)
    if (d.blend.ground[s] != 0) used.push_back(s);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const PlaneView& to = targets[i];
    if (used.size() == 1) {
      copy(planes_of(d.pattern(used.front()).picture)[i], to);
      continue;
    }
    std::vector<std::uint16_t> sum(to.width);
    for (int y = 0; y < to.height; ++y) {
      std::fill(sum.begin(), sum.end(), kCoarseOne / 2);
      for (const std::size_t s : used)
        add_scaled(planes_of(d.pattern(s).picture)[i].row(y), d.blend.ground[s] / kShareOne, sum.data(), to.width);
      round_sum(sum.data(), to.row(y), to.width);
    }
  }
}

bool same_size(const ConstPlaneView& a, const ConstPlaneView& b) {
  return a.width == b.width && a.height == b.height;
}

bool fits(const TextureMesh& texture, const SceneGeometry& geometry) {
  const std::size_t points = geometry.surround().point_count();
  return texture.head.size() == head_mesh().vertex_count && texture.visible.size() == texture.head.size() &&
         texture.surround.size() == points && texture.seen_surround.size() == points;
}

Result<void> check(const Scene& scene) {
  if (scene.patterns.empty()) return fail(ErrorCode::kInvalidArgument, "the scene has no pattern yet");
  for (const Pattern& p : scene.patterns) {
    if (scene.geometry && !fits(p.texture, *scene.geometry))
      return fail(ErrorCode::kInvalidArgument, "a pattern's texture mesh is not of the scene's geometry");
    if (p.picture.width() != scene.patterns.front().picture.width() ||
        p.picture.height() != scene.patterns.front().picture.height())
      return fail(ErrorCode::kInvalidArgument, "patterns of different sizes");
  }
  return {};
}

/// Without a face the cross-fade of the patterns is all there is.
MeshBlend blend_without_mesh(const PictureBlend& blend) {
  MeshBlend out;
  for (const WeightedSource& s : blend[static_cast<std::size_t>(Region::kGround)]) {
    out.sources.push_back({s.source.pattern, true});
    out.ground.push_back(s.weight * kShareOne);
  }
  return out;
}

}  // namespace

Result<void> Renderer::render(const Scene& scene, const State& state, const PictureView& out) {
  if (auto checked = check(scene); !checked) return checked;
  const auto first = planes_of(scene.patterns.front().picture);
  const std::array<PlaneView, 3> targets = {out.y, out.u, out.v};
  if (!std::equal(first.begin(), first.end(), targets.begin(), same_size))
    return fail(ErrorCode::kInvalidArgument, "the picture to draw into has another size than the scene");

  std::vector<const State*> seen;
  std::vector<const TextureMesh*> textures;
  for (const Pattern& p : scene.patterns) {
    seen.push_back(&p.seen);
    textures.push_back(&p.texture);
  }
  const PictureBlend regions = blend_picture(seen, state);
  const MeshBlend blend =
      scene.geometry ? blend_mesh(regions, *scene.geometry, textures) : blend_without_mesh(regions);
  const ScreenMesh mesh = scene.geometry ? scene.geometry->screen_mesh(state) : ScreenMesh{};
  const Drawing drawing{scene, mesh, blend};
  draw_base(drawing, targets);
  if (!scene.geometry) return {};

  const MouthInterior& mouth = scene.setup.mouth;
  const std::array<InteriorColours, 3> interior = {interior_colours(mouth, &YuvColour::y, mesh.interior),
                                                   interior_colours(mouth, &YuvColour::u, {}),
                                                   interior_colours(mouth, &YuvColour::v, {})};
  const auto layer = [&](PlaneScale scale, std::size_t begin, std::size_t count) {
    const SampleArea whole{0, 0, targets[begin].width, targets[begin].height};
    Layer l{scale, begin, count, {}, {scale, std::span(targets).subspan(begin, count), whole}, {}};
    for (std::size_t s = 0; s < blend.sources.size(); ++s) {
      const auto planes = planes_of(drawing.pattern(s).picture);
      l.textures.emplace_back(planes.begin() + begin, planes.begin() + begin + count);
    }
    l.interior = std::span(interior).subspan(begin, count);
    return l;
  };
  const std::array<Layer, 2> layers = {layer(PlaneScale::kLuma, 0, 1), layer(PlaneScale::kChroma, 1, 2)};
  SurroundPainter surround(drawing, layers);
  for (const Surround::Cell& cell : scene.geometry->surround().cells()) surround.draw(cell);
  HeadPainter(drawing, layers[0], luma_depth_).draw();
  HeadPainter(drawing, layers[1], chroma_depth_).draw();
  return {};
}

Result<void> Renderer::render(const Scene& scene, const State& state, Picture& out) {
  if (auto checked = check(scene); !checked) return checked;
  const Picture& pattern = scene.patterns.front().picture;
  if (out.width() != pattern.width() || out.height() != pattern.height())
    out = Picture(pattern.width(), pattern.height());
  return render(scene, state, PictureView(out));
}

}  // namespace fbs
