#include "decoder/contrast_map.h"

#include <algorithm>
#include <cmath>

#include "bitstream/syntax.h"
#include "decoder/head/head_mesh.h"
#include "decoder/raster/rasteriser.h"

namespace fbs {
namespace {

constexpr int kMiddle = 128, kFaceOne = 255;
constexpr int kInverseOneLog2 = 16;

/// The face's share of each sample.
Plane face_share(int width, int height, PlaneScale scale, const TextureMesh& texture) {
  Plane out(width, height), face(1, 1, kFaceOne), none(1, 1, 0);
  const PlaneView target(out);
  const ConstPlaneView face_view(face), none_view(none);
  std::array<TextureSource, 2> sources;
  sources[0].planes = {&face_view, 1};
  sources[1].planes = {&none_view, 1};
  std::array<PlaneView, 2> targets{target, target};
  std::array<ConstPlaneView, 2> faces{face_view, face_view}, nones{none_view, none_view};
  const std::size_t planes = scale == PlaneScale::kLuma ? 1 : 2;
  sources[0].planes = std::span<const ConstPlaneView>(faces).first(planes);
  sources[1].planes = std::span<const ConstPlaneView>(nones).first(planes);
  const RasterTarget raster{scale, std::span<const PlaneView>(targets).first(planes), {0, 0, width, height}, nullptr};
  for (const HeadTriangle& triangle : head_mesh().triangles) {
    ScreenTriangle t;
    for (std::size_t i = 0; i < t.size(); ++i) {
      t[i] = {texture.head[triangle[i]], 0};
      sources[0].weight[i] = triangle[i] < kVertexCount ? kWeightOne : 0;
    }
    draw_triangle(t, sources, raster);
  }
  return out;
}

/// Contrast for each share of the face, 1..kContrastOne.
std::array<std::int32_t, kFaceOne + 1> contrasts(std::int32_t surround) {
  std::array<std::int32_t, kFaceOne + 1> out{};
  for (int share = 0; share <= kFaceOne; ++share)
    out[share] = surround + ((kContrastOne - surround) * share + kFaceOne / 2) / kFaceOne;
  return out;
}

}  // namespace

ContrastMap::ContrastMap(int width, int height, const TextureMesh& texture, std::int32_t surround)
    : luma_(face_share(width, height, PlaneScale::kLuma, texture)),
      chroma_(face_share((width + 1) / 2, (height + 1) / 2, PlaneScale::kChroma, texture)),
      surround_(surround) {}

void ContrastMap::expand(Picture& picture) const {
  auto inverse = contrasts(surround_);
  for (std::int32_t& c : inverse) c = ((kContrastOne << kInverseOneLog2) + c / 2) / c;
  std::array<Plane*, 3> planes{&picture.y, &picture.u, &picture.v};
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const Plane& map = *maps()[p];
    for (std::size_t i = 0; i < map.samples.size(); ++i) {
      std::uint8_t& v = planes[p]->samples[i];
      const std::int32_t away = (v - kMiddle) * inverse[map.samples[i]];
      v = static_cast<std::uint8_t>(
          std::clamp(kMiddle + ((away + (1 << (kInverseOneLog2 - 1))) >> kInverseOneLog2), 0, 255));
    }
  }
}

void ContrastMap::reduce(Picture& picture) const {
  const auto contrast = contrasts(surround_);
  std::array<Plane*, 3> planes{&picture.y, &picture.u, &picture.v};
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const Plane& map = *maps()[p];
    for (std::size_t i = 0; i < map.samples.size(); ++i) {
      std::uint8_t& v = planes[p]->samples[i];
      v = static_cast<std::uint8_t>(kMiddle + (((v - kMiddle) * contrast[map.samples[i]] + kContrastOne / 2) >> 8));
    }
  }
}

}  // namespace fbs
