// A picture is a function of (scene, state): this function. SPEC 10.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "decoder/blend/picture_blend.h"
#include "decoder/draw/atlas_blend.h"
#include "decoder/draw/surround_painter.h"
#include "decoder/field/surround_field.h"
#include "decoder/raster/rasteriser.h"
#include "decoder/scene/scene.h"

namespace fbs {

/// Draws pictures of a scene. Keeps scratch memory only: the result depends on the arguments alone.
class Renderer {
 public:
  /// Draws the picture of `state` into `out`, whose planes have the pattern's sizes.
  /// @return kInvalidArgument, and `out` untouched, when the scene has no pattern, when its pattern's texture
  ///         mesh is not one of the scene's geometry, or when `out` has another size
  [[nodiscard]] Result<void> render(const Scene& scene, const State& state, const PictureView& out);

  /// The same into a picture, which is resized to the pattern's size.
  [[nodiscard]] Result<void> render(const Scene& scene, const State& state, Picture& out);

  /// Draws the picture of `state` from one pattern alone, warped everywhere, whatever the modes of the state.
  /// @param pattern  index into Scene::patterns
  /// @return kInvalidArgument as above, and when there is no such pattern
  [[nodiscard]] Result<void> render_from(std::size_t pattern, const Scene& scene, const State& state,
                                         Picture& out);

  /// Draws an area of the picture's luma; the rest is undefined.
  [[nodiscard]] Result<void> render_luma(const Scene& scene, const State& state, const SampleArea& area,
                                         const PlaneView& out);

 private:
  using Targets = std::array<PlaneView, 3>;
  void draw(const Scene& scene, const State& state, const PictureBlend& regions, const Targets& targets,
            const SampleArea& luma, const SampleArea& chroma);

  /// Computes cover_, weights_ and field_.
  void find_nodes(const Scene& scene, const NodeGrid& grid, const Drawing& drawing);

  NodeCover cover_;
  NodeWeights weights_;
  std::vector<const std::vector<glm::ivec2>*> seen_;  ///< the grid's points in each source
  SurroundField field_;
  AtlasBlend atlas_;
  SurroundPainter surround_;
  std::array<Rasteriser, 2> raster_;  ///< the head in luma and chroma
};

}  // namespace fbs
