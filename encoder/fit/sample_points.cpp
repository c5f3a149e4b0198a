#include "encoder/fit/sample_points.h"

#include <algorithm>
#include <cmath>

#include "decoder/head/mouth_interior.h"
#include "encoder/fit/fit_tuning.h"

namespace fbs {
namespace {

float mouth_ramp_of(const SurfacePoint& p) {
  if (!is_mouth(generic_head(), p.corner)) return -1;
  constexpr float kRampOne = 256;  // of the decoder's mouth_ramp()
  float ramp = 0;
  for (std::size_t i = 0; i < 3; ++i)
    ramp += p.barycentric[i] * static_cast<float>(mouth_ramp(generic_head(), p.corner[i])) / kRampOne;
  return ramp;
}

/// The light's polynomial at a vertex, without the gain. SPEC 10.
std::array<double, kLightCount> light_of_vertex(glm::dvec3 position) {
  constexpr double kMiddle = kFaceMiddle / static_cast<double>(kUnitsPerEyeDistance);
  const glm::dvec3 p = position / static_cast<double>(kUnitsPerEyeDistance);
  const double v = p.y - kMiddle;
  return {1, 0, p.x, p.y, p.x * p.x, v * v, p.x * v};
}

std::array<double, kLightCount> light_of(const Geometry& geometry, const SurfacePoint& p) {
  std::array<double, kLightCount> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto corner = light_of_vertex(glm::dvec3(geometry.positions[p.corner[i]]));
    for (std::size_t j = 0; j < kLightCount; ++j) out[j] += static_cast<double>(p.barycentric[i]) * corner[j];
  }
  return out;
}

/// Skinning weight of each control point at a vertex.
std::array<double, kControlCount> weights_of(std::size_t vertex) {
  std::array<double, kControlCount> out{};
  for (const SkinningWeight& skinning : skinning_of(vertex))
    out[skinning.control] = skinning.weight / static_cast<double>(kSkinningOne);
  return out;
}

}  // namespace

SamplePoints::SamplePoints(const Geometry& geometry, const FitColumns& columns, const PlacedHead& seen,
                           double spacing_px)
    : points_(spread_over_mesh(seen.vertices, seen.projection, spacing_px, kMinMouthRows)) {
  for (const SurfacePoint& p : points_) {
    light_.push_back(light_of(geometry, p));
    mouth_ramp_.push_back(mouth_ramp_of(p));
  }
  for (std::size_t k = 0; k < points_.size();) {
    std::size_t end = k;
    while (end < points_.size() && points_[end].triangle == points_[k].triangle) ++end;
    patches_.push_back(patch_of(columns, k, end));
    k = end;
  }
}

double SamplePoints::samples_per_point(std::size_t n, const PlacedHead& head) const {
  const Patch& patch = patches_[n];
  return head.visible_area(points_[patch.first].corner) / static_cast<double>(patch.size());
}

SamplePoints::Patch SamplePoints::patch_of(const FitColumns& columns, std::size_t first,
                                           std::size_t end) const {
  const auto& corner = points_[first].corner;
  const std::array<std::array<double, kControlCount>, 3> weight = {
      weights_of(corner[0]), weights_of(corner[1]), weights_of(corner[2])};
  Patch patch{first, end, {}, {}, {}};
  const std::size_t shared = mouth_ramp(first) < 0 ? FitColumns::kFirstInterior : FitColumns::kFirstControl;
  for (std::size_t i = 0; i < shared; ++i) patch.columns.push_back(static_cast<std::uint16_t>(i));
  for (std::size_t c = 0; c < kControlCount; ++c)
    if (columns.has(c) && std::max({std::abs(weight[0][c]), std::abs(weight[1][c]), std::abs(weight[2][c])}) >
                              kMinSkinningShare)
      patch.controls.push_back(static_cast<std::uint16_t>(c));
  for (const std::uint16_t control : patch.controls)
    for (std::size_t axis = 0; axis < 2; ++axis)
      patch.columns.push_back(static_cast<std::uint16_t>(columns.of(control) + axis));
  for (std::size_t k = first; k < end; ++k)
    for (const std::uint16_t control : patch.controls) {
      double share = 0;
      for (std::size_t i = 0; i < 3; ++i)
        share += static_cast<double>(points_[k].barycentric[i]) * weight[i][control];
      patch.shares.push_back(static_cast<float>(share));
    }
  return patch;
}

}  // namespace fbs
