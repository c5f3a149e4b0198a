// Converts between planes Y, Cb, Cr and RGB.
#pragma once

#include <fbs/fbs.h>
#include <nanobind/nanobind.h>

#include "plane_view.h"

namespace fbs_python {

/// The meaning of a picture's samples. FBS_MATRIX_UNSPECIFIED counts as BT.601.
struct Colours {
  fbs_matrix matrix;
  bool full_range;
};

/// Each chroma sample serves its four pixels. The sizes must be equal.
void rgb_of(const fbs_const_picture& picture, const Colours& colours, const RgbView<std::uint8_t>& out);

/// The inverse; chroma is the mean of the pixels it belongs to.
void planes_of(const RgbView<const std::uint8_t>& rgb, const Colours& colours, const fbs_picture& out);

/// Functions `rgb_from_planes` and `planes_from_rgb`.
void bind_colour(nanobind::module_& module);

}  // namespace fbs_python
