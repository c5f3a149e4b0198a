// Finishes the samples of a source between pattern and picture: light. SPEC 10.11.
// Integers only.
#pragma once

#include <array>
#include <cstdint>

#include "common/state.h"
#include "decoder/raster/row_block.h"

namespace fbs {

/// Addition to luma, linear over the triangle.
struct Light {
  std::array<std::int32_t, 3> offset{}, gain{};  ///< at the corners, as VertexLight
};

/// Steps in order; null: left out.
struct Finish {
  const Light* light_before = nullptr;  ///< light in the texture's luma, removed
  const Light* light = nullptr;         ///< light added to luma
};

inline constexpr int kLightOneLog2 = 16;  ///< light along a run is in 2^-16 of 1/16 grey level

/// Adds light to luma in place. Offset and gain are clamped to +-kMaxLight: slivers, whose gradients are
/// clamped, exceed the values at their corners.
/// @param offset, gain  as VertexLight, Q16
void light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count);

/// The inverse: luma before this light fell on it.
void take_back_light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count);

/// light_row() and take_back_light_row() for a block of a triangle.
class LightPainter {
 public:
  LightPainter(const TriangleSetup& setup, const Light& light);
  [[nodiscard]] Lanes paint(const RowBlock<PlaneScale::kLuma>& block, Lanes luma) const;
  [[nodiscard]] Lanes take_back(const RowBlock<PlaneScale::kLuma>& block, Lanes luma) const;

 private:
  Gradient offset_, gain_;
  std::array<SignedWideLanes, 2> offset_lanes_, gain_lanes_;  ///< what each lane adds to the first sample's
};

}  // namespace fbs
