#include "decoder/field/padded_plane.h"

#include <algorithm>

namespace fbs {

PaddedPlane::PaddedPlane(const ConstPlaneView& plane, int inset)
    : stride_(plane.width + 2 * kPlanePadding),
      samples_(static_cast<std::size_t>(stride_) * (plane.height + 2 * kPlanePadding)) {
  std::uint8_t* out = samples_.data();
  for (int y = -kPlanePadding; y < plane.height + kPlanePadding; ++y, out += stride_) {
    const std::uint8_t* const row = plane.row(std::clamp(y, inset, plane.height - 1 - inset));
    const int inside = kPlanePadding + inset;
    std::fill_n(out, inside, row[inset]);
    std::copy(row + inset, row + plane.width - inset, out + inside);
    std::fill_n(out + stride_ - inside, inside, row[plane.width - 1 - inset]);
  }
}

PaddedPicture padded(const Picture& picture) {
  return {PaddedPlane(picture.y, kLumaInset), PaddedPlane(picture.u, kChromaInset),
          PaddedPlane(picture.v, kChromaInset)};
}

}  // namespace fbs
