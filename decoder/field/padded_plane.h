// Patterns with a border all round, as displaced patches need them. SPEC 10.3. Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/picture.h"

namespace fbs {

/// A displaced patch may lie this far outside a picture, luma samples.
inline constexpr int kMaxOutside = 24;

/// Readable samples beyond each side of a plane: kMaxOutside, half a step of rounding, the neighbour for
/// bilinear sampling, and samples that vectors read but do not use.
inline constexpr int kPlanePadding = 32;

/// Border samples that are not trusted: in many videos they are dark.
inline constexpr int kLumaInset = 2, kChromaInset = 1;

/// A plane with kPlanePadding samples around it. The padding and the outermost samples of the plane itself
/// repeat the samples a little inside its border.
class PaddedPlane {
 public:
  /// @param inset  border samples that are not trusted
  PaddedPlane(const ConstPlaneView& plane, int inset);

  /// @param x, y  -kPlanePadding .. size of the plane + kPlanePadding - 1
  [[nodiscard]] const std::uint8_t* at(int x, int y) const {
    return samples_.data() + static_cast<std::ptrdiff_t>(y + kPlanePadding) * stride_ + x + kPlanePadding;
  }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }

 private:
  std::ptrdiff_t stride_;
  std::vector<std::uint8_t> samples_;
};

/// Y, U, V.
using PaddedPicture = std::array<PaddedPlane, 3>;
[[nodiscard]] PaddedPicture padded(const Picture& picture);

}  // namespace fbs
