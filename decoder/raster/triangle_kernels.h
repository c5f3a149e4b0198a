// The inner loops of drawing triangles: which samples show one, then what they show. SPEC 10.6 to 10.11 and
// 11.6. Vector code for every kind of processor that Highway knows, chosen at run time;
// triangle_kernels_plain.h defines the results. Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/picture.h"
#include "decoder/raster/row_runs.h"
#include "decoder/raster/triangle_setup.h"

namespace fbs {

inline constexpr int kWeightOneLog2 = 12;
inline constexpr int kWeightOne = 1 << kWeightOneLog2;  ///< weights in a blend sum to this

/// A triangle that faces the viewer.
struct DrawnTriangle {
  std::array<Edge, 3> edges;
  SampleArea box;  ///< contains all samples; not empty
  LinearPlane depth;
  /// Quantities that count; later ones are zero: weights behind the triangle's last source.
  std::size_t used;
  bool is_short;  ///< whether depth, quantities and edges fit 32 bits in the box, as they nearly always do
};

enum class LightUse : std::uint8_t { kNone, kAdded, kTakenBack };

/// Where samples come from and go.
struct Shading {
  /// A plane of luma, or two of chroma; of one size from 2 x 2, or without width if no triangle shows it.
  std::span<const ConstPlaneView> texture;
  LightUse light;  ///< of the texture; luma only
  /// Still sources, which are shown where they are: sources x planes, each of the target's size.
  std::span<const ConstPlaneView> still;
  std::span<const PlaneView> target;  ///< as many as of the texture

  [[nodiscard]] bool has_light() const { return light != LightUse::kNone; }
  [[nodiscard]] std::size_t still_count() const { return still.size() / target.size(); }
  [[nodiscard]] const ConstPlaneView& still_plane(std::size_t source, std::size_t plane) const {
    return still[source * target.size() + plane];
  }
};

/// What triangles show is linear over each. Quantities are, in this order: positions in the texture u and v,
/// 2^-16 sample with integers at the centres of samples; if there is light, its offset and gain as in lit();
/// and the weights of all sources but the last, texture first, in 2^-16 of 1 / kWeightOne. The last gets what
/// the others leave.
struct TriangleList {
  std::vector<DrawnTriangle> triangles;  ///< in drawing order
  std::size_t quantity_count;
  std::vector<LinearPlane> quantities;  ///< of each triangle

  [[nodiscard]] std::span<const LinearPlane> quantities_of(const DrawnTriangle& t) const {
    const auto number = static_cast<std::size_t>(&t - triangles.data());
    return std::span(quantities).subspan(number * quantity_count, quantity_count);
  }
};

/// Draws the samples in depth.area that are nearer than the depth recorded, which is updated.
void draw_triangles(const TriangleList& list, const Shading& shading, DepthPlane& depth);

/// Samples of a part of depth.area that something was drawn on.
[[nodiscard]] int count_covered(const DepthPlane& depth, const SampleArea& part);

}  // namespace fbs
