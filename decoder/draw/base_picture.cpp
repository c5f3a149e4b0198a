#include "decoder/draw/base_picture.h"

#include <algorithm>
#include <utility>

#include "decoder/raster/blend_weights.h"
#include "decoder/raster/lanes.h"

namespace fbs {
namespace {

static_assert(kCoarseStep == kShareOne && kCoarseOne == kBlendOne);
static_assert(kMinPictureSize / 2 >= kLaneCount);

struct WeightedPlane {
  ConstPlaneView plane;
  Lanes weight;  ///< of kCoarseOne, the same in all lanes
};

void copy(const ConstPlaneView& from, const SampleArea& area, const PlaneView& to) {
  for (int y = area.y0; y < area.y1; ++y)
    std::copy(from.row(y) + area.x0, from.row(y) + area.x1, to.row(y) + area.x0);
}

/// @param kCount  of the planes, so that the innermost loop is none
template <std::size_t kCount>
void blend(std::span<const WeightedPlane, kCount> from, const SampleArea& area, const PlaneView& to) {
  for (int y = area.y0; y < area.y1; ++y) {
    std::array<const std::uint8_t*, kCount> rows;
    for (std::size_t i = 0; i < kCount; ++i) rows[i] = from[i].plane.row(y);
    for (int x = area.x0; x < area.x1; x += kLaneCount) {
      const int first = std::min(x, to.width - kLaneCount);  // the last eight may overlap those before
      Lanes sum = Lanes{} + std::uint16_t{kCoarseOne / 2};
      for (std::size_t i = 0; i < kCount; ++i) sum += load_lanes(rows[i] + first) * from[i].weight;
      store_lanes(sum >> kCoarseOneLog2, to.row(y) + first);
    }
  }
}

/// Calls blend() for the number of planes.
template <std::size_t... kCounts>
void blend(std::span<const WeightedPlane> from, const SampleArea& area, const PlaneView& to,
           std::index_sequence<kCounts...>) {
  ((from.size() == kCounts + 1 ? blend<kCounts + 1>(from.first<kCounts + 1>(), area, to) : void()), ...);
}

}  // namespace

void draw_base(const Drawing& drawing) {
  for (std::size_t i = 0; i < drawing.target.size(); ++i) {
    const SampleArea& area = drawing.area(i == 0 ? PlaneScale::kLuma : PlaneScale::kChroma);
    if (area.empty()) continue;
    std::vector<WeightedPlane> from;
    for (std::size_t s = 0; s < drawing.sources.size(); ++s)
      if (const std::int32_t weight = drawing.blend.ground[s] / kShareOne; weight != 0)
        from.push_back({drawing.sources[s].planes[i], Lanes{} + static_cast<std::uint16_t>(weight)});
    if (from.size() == 1)
      copy(from.front().plane, area, drawing.target[i]);
    else
      blend(from, area, drawing.target[i], std::make_index_sequence<kMaxRegionSources>());
  }
}

}  // namespace fbs
