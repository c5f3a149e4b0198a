// Patterns as displaced patches read them: with a border all round. SPEC 10.3. Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/picture.h"

namespace fbs {

/// A displaced patch may lie this far outside a picture, luma samples.
inline constexpr int kMaxOutside = 24;

/// Samples that can be read beyond each side of a plane: kMaxOutside, half a step of rounding, the neighbour
/// that bilinear sampling takes, and what vectors read and do not use.
inline constexpr int kPadding = 32;

/// Samples of the border that are not believed: in many videos they are dark.
inline constexpr int kLumaInset = 2, kChromaInset = 1;

/// A plane with kPadding samples round it. They, and the outermost ones of the plane itself, repeat what lies
/// a little inside its border.
class PaddedPlane {
 public:
  /// @param inset  samples of the border that are not believed
  PaddedPlane(const ConstPlaneView& plane, int inset);

  /// @param x, y  -kPadding .. size of the plane + kPadding - 1
  [[nodiscard]] const std::uint8_t* at(int x, int y) const {
    return samples_.data() + static_cast<std::ptrdiff_t>(y + kPadding) * stride_ + x + kPadding;
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
