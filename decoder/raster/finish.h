// Finishes the samples of a source between pattern and picture: light and mouth interior. SPEC 10.10, 10.11.
// Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/state.h"
#include "decoder/raster/row_block.h"

namespace fbs {

/// Addition to luma, linear over the triangle.
struct Light {
  std::array<std::int32_t, 3> offset{}, gain{};  ///< at the corners, as VertexLight
};

/// Colours mixed into the samples, from the upper to the lower lip.
struct InteriorMix {
  std::array<std::int32_t, 3> ramp;  ///< at the corners, 0..256; linear over the triangle
  std::int32_t opacity = 0;          ///< 0..256
  /// Colours of each plane where the ramp is 0, 128 and 256.
  std::span<const std::array<std::uint8_t, kInteriorCount>> colours;
};

/// Steps in order; null: left out.
struct Finish {
  const Light* light_before = nullptr;    ///< light in the texture's luma, removed
  const Light* light = nullptr;           ///< light added to luma
  const InteriorMix* interior = nullptr;  ///< mixed into all planes last
};

inline constexpr int kLightOneLog2 = 16;  ///< light along a run is in 2^-16 of 1/16 grey level

/// Adds light to luma in place. Offset and gain are clamped to +-kMaxLight: slivers, whose gradients are
/// clamped, exceed the values at their corners.
/// @param offset, gain  as VertexLight, Q16
void light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count);

/// The inverse: luma before this light fell on it.
void take_back_light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count);

/// Mixes colours into samples in place.
/// @param colours  where the ramp is 0, 128 and 256
/// @param opacity  0..256
/// @param ramp     place between upper and lower lip, 0..256 in Q16; clamped
void mix_interior_row(std::uint8_t* samples, const std::array<std::uint8_t, kInteriorCount>& colours,
                      std::int32_t opacity, const LinearRow& ramp, int count);

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

/// mix_interior_row() for a block of a triangle.
template <PlaneScale kScale>
class InteriorPainter {
 public:
  InteriorPainter(const TriangleSetup& setup, const InteriorMix& mix)
      : mix_(mix), ramp_(setup.gradient(mix.ramp, 0)) {}

  void paint(const RowBlock<kScale>& block, BlockSamples<kScale>& samples) const {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      std::array<std::uint8_t, kLaneCount> row;
      store_lanes(samples[i], row.data());
      mix_interior_row(row.data(), mix_.colours[i], mix_.opacity, block.along(ramp_), block.count);
      samples[i] = load_lanes(row.data());
    }
  }

 private:
  const InteriorMix& mix_;
  Gradient ramp_;
};

}  // namespace fbs
