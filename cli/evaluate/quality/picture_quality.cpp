#include "cli/evaluate/quality/picture_quality.h"

#include <algorithm>

#include "cli/evaluate/quality/structural_similarity.h"

namespace fbs::cli {
namespace {

Plane cut(const Plane& p, const PixelBox& box) {
  Plane out(box.width, box.height);
  for (int y = 0; y < box.height; ++y) std::copy_n(p.row(box.y + y) + box.x, box.width, out.row(y));
  return out;
}

/// A chroma sample is inside where the upper left of its luma samples is.
Plane chroma_mask(const Plane& luma) {
  Plane out((luma.width + 1) / 2, (luma.height + 1) / 2);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) out.row(y)[x] = luma.row(2 * y)[2 * x];
  return out;
}

void take_similarity(const Plane& a, const Plane& b, AreaQuality& out) {
  const StructuralSimilarity s = structural_similarity(a, b);
  out.ssim = s.ssim;
  out.ms_ssim = s.ms_ssim;
}

void add(const AreaQuality& area, AreaSummary& sum) {
  ++sum.pictures;
  sum.y += area.y;
  sum.u += area.u;
  sum.v += area.v;
  sum.ssim += area.ssim;
  sum.ms_ssim += area.ms_ssim;
}

void divide(AreaSummary& sum) {
  const auto count = static_cast<double>(std::max<std::uint64_t>(1, sum.pictures));
  sum.ssim /= count;
  sum.ms_ssim /= count;
}

}  // namespace

PictureQuality compare_pictures(const Picture& source, const Picture& shown, const FaceOutline& face) {
  PictureQuality out;
  out.frame.y = squared_error(source.y, shown.y);
  out.frame.u = squared_error(source.u, shown.u);
  out.frame.v = squared_error(source.v, shown.v);
  take_similarity(source.y, shown.y, out.frame);
  Plane mask(source.width(), source.height());
  const PixelBox box = draw_face(face, mask);
  if (box.empty()) return out;
  AreaQuality& area = out.face.emplace();
  area.y = squared_error(source.y, shown.y, mask);
  const Plane chroma = chroma_mask(mask);
  area.u = squared_error(source.u, shown.u, chroma);
  area.v = squared_error(source.v, shown.v, chroma);
  take_similarity(cut(source.y, box), cut(shown.y, box), area);
  return out;
}

QualitySummary summarise(std::span<const PictureQuality> pictures) {
  QualitySummary sum;
  for (const PictureQuality& p : pictures) {
    add(p.frame, sum.frame);
    if (p.face) add(*p.face, sum.face);
  }
  divide(sum.frame);
  divide(sum.face);
  return sum;
}

}  // namespace fbs::cli
