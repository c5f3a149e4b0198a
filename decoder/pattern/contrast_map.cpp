#include "decoder/pattern/contrast_map.h"

#include <algorithm>

#include "bitstream/syntax.h"
#include "decoder/raster/rasteriser.h"

namespace fbs {
namespace {

constexpr int kMiddle = 128, kFaceShareOne = 255, kInverseOneLog2 = 16;

using Contrasts = std::array<std::int32_t, kFaceShareOne + 1>;

/// For each share of the face.
Contrasts contrasts(std::int32_t face, std::int32_t surround) {
  Contrasts out{};
  for (int share = 0; share <= kFaceShareOne; ++share)
    out[share] = surround + ((face - surround) * share + kFaceShareOne / 2) / kFaceShareOne;
  return out;
}

/// 1 / contrast, 16 fractional bits.
Contrasts inverse(Contrasts contrast) {
  for (std::int32_t& c : contrast) c = ((kContrastOne << kInverseOneLog2) + c / 2) / c;
  return contrast;
}

/// Shares of the face: two constant textures blended over the head and the ring round it.
Plane draw_shares(int width, int height, PlaneScale scale, const HeadMesh& head, const TextureMesh& texture) {
  Plane out(width, height), unused = out;
  const Plane face(1, 1, kFaceShareOne), surround(1, 1, 0);
  const std::array<ConstPlaneView, 2> face_planes{face, face}, surround_planes{surround, surround};
  const std::array<PlaneView, 2> target_planes{out, unused};
  const std::size_t count = plane_count(scale);
  std::array<TextureSource, 2> sources{};  // one sample each: any corners will do, but not undefined ones
  sources[0].planes = std::span(face_planes).first(count);
  sources[1].planes = std::span(surround_planes).first(count);
  const RasterTarget target{scale, std::span(target_planes).first(count), {0, 0, width, height}};
  for (const HeadTriangle& triangle : head.triangles) {
    ScreenTriangle t;
    for (std::size_t i = 0; i < t.size(); ++i) {
      t[i] = {texture.head[triangle[i]], 0};
      sources[0].weight[i] = triangle[i] < head.head_count ? kWeightOne : 0;
    }
    draw_triangle(t, sources, target);
  }
  return out;
}

/// Replaces each sample by change(sample - 128, contrast). Most samples lie wholly inside or outside the
/// face: tables cover those.
template <class Change>
void for_each_sample(Plane& plane, const Plane& shares, const Contrasts& contrast, Change&& change) {
  const auto changed = [&](int v, int share) {
    return static_cast<std::uint8_t>(std::clamp(kMiddle + change(v - kMiddle, contrast[share]), 0, 255));
  };
  std::array<std::uint8_t, 256> outside, inside;
  for (int v = 0; v < 256; ++v) {
    outside[v] = changed(v, 0);
    inside[v] = changed(v, kFaceShareOne);
  }
  for (std::size_t i = 0; i < plane.samples.size(); ++i) {
    std::uint8_t& v = plane.samples[i];
    const std::uint8_t share = shares.samples[i];
    v = share == 0 ? outside[v] : share == kFaceShareOne ? inside[v] : changed(v, share);
  }
}

}  // namespace

ContrastMap::ContrastMap(const Setup& setup, const HeadMesh& head, const TextureMesh& texture)
    : luma_(draw_shares(setup.format.width, setup.format.height, PlaneScale::kLuma, head, texture)),
      chroma_(draw_shares((setup.format.width + 1) / 2, (setup.format.height + 1) / 2, PlaneScale::kChroma,
                          head, texture)),
      surround_(setup.contrast),
      face_chroma_(setup.chroma_contrast) {}

void ContrastMap::expand(Picture& picture) const {
  const auto change = [](std::int32_t v, std::int32_t by) {
    return (v * by + (1 << (kInverseOneLog2 - 1))) >> kInverseOneLog2;
  };
  const Contrasts chroma = inverse(contrasts(face_chroma_, surround_));
  for_each_sample(picture.y, luma_, inverse(contrasts(kContrastOne, surround_)), change);
  for_each_sample(picture.u, chroma_, chroma, change);
  for_each_sample(picture.v, chroma_, chroma, change);
}

void ContrastMap::reduce(Picture& picture) const {
  const auto change = [](std::int32_t v, std::int32_t by) {
    return (v * by + kContrastOne / 2) >> kContrastOneLog2;
  };
  const Contrasts chroma = contrasts(face_chroma_, surround_);
  for_each_sample(picture.y, luma_, contrasts(kContrastOne, surround_), change);
  for_each_sample(picture.u, chroma_, chroma, change);
  for_each_sample(picture.v, chroma_, chroma, change);
}

}  // namespace fbs
