// The sources that show in a triangle of the mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "decoder/draw/drawing.h"
#include "decoder/raster/rasteriser.h"

namespace fbs {

static_assert(kMeshWeightOne == kWeightOne);
static_assert(kMaxTriangleSources == kRegionCount * kMaxRegionSources);

/// Made anew for each triangle, in the same memory.
class TriangleSources {
 public:
  /// Takes the sources that have weight at some corner. Corners and weights are set; planes and finish are
  /// not.
  /// @param positions  of the points in a source's texture
  template <class Positions>
  void collect(const Drawing& drawing, const PointWeights& weights, const std::array<int, 3>& points,
               Positions&& positions) {
    const auto a = weights.at(points[0]), b = weights.at(points[1]), c = weights.at(points[2]);
    count_ = 0;
    for (std::size_t s = 0; s < weights.sources; ++s) {
      if ((a[s] | b[s] | c[s]) == 0) continue;
      drawn_[count_] = &drawing.sources[s];
      items_[count_] = {{}, positions(drawing.sources[s]), {}, {a[s], b[s], c[s]}};
      ++count_;
    }
  }

  void set_scale(PlaneScale scale) {
    for (std::size_t i = 0; i < count_; ++i) items_[i].planes = planes_of_scale(drawn_[i]->planes, scale);
  }

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] const DrawnSource& drawn(std::size_t i) const { return *drawn_[i]; }
  [[nodiscard]] TextureSource& operator[](std::size_t i) { return items_[i]; }
  [[nodiscard]] std::span<const TextureSource> all() const { return std::span(items_).first(count_); }

 private:
  std::array<TextureSource, kMaxTriangleSources> items_;
  std::array<const DrawnSource*, kMaxTriangleSources> drawn_;
  std::size_t count_ = 0;
};

}  // namespace fbs
