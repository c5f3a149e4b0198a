// Planes of a picture in numpy's memory.
#pragma once

#include <fbs/fbs.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>

namespace fbs_python {

using PlaneArray = nanobind::ndarray<std::uint8_t, nanobind::ndim<2>, nanobind::device::cpu>;
using ConstPlaneArray = nanobind::ndarray<const std::uint8_t, nanobind::ndim<2>, nanobind::device::cpu>;
using RgbArray = nanobind::ndarray<std::uint8_t, nanobind::shape<-1, -1, 3>, nanobind::device::cpu>;
using ConstRgbArray =
    nanobind::ndarray<const std::uint8_t, nanobind::shape<-1, -1, 3>, nanobind::device::cpu>;

/// Rows may lie anywhere, even upwards; samples of a row are contiguous. The arrays must outlive the result.
/// Throws StatusError where shapes or strides do not fit.
[[nodiscard]] fbs_picture view_of(const PlaneArray& y, const PlaneArray& u, const PlaneArray& v);
[[nodiscard]] fbs_const_picture view_of(const ConstPlaneArray& y, const ConstPlaneArray& u,
                                        const ConstPlaneArray& v);

/// Red, green, blue: three contiguous bytes per pixel, pixels of a row contiguous.
template <class Sample>
struct RgbView {
  std::uint32_t width, height;
  Sample* data;
  std::ptrdiff_t stride;  ///< bytes from a row to the next one below
};
[[nodiscard]] RgbView<std::uint8_t> view_of(const RgbArray& rgb);
[[nodiscard]] RgbView<const std::uint8_t> view_of(const ConstRgbArray& rgb);

}  // namespace fbs_python
