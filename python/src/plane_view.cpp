#include "plane_view.h"

#include "status_error.h"

namespace fbs_python {
namespace {

constexpr const char* kShapes =
    "planes are (height, width), and twice ((height + 1) // 2, (width + 1) // 2), rows contiguous";
constexpr const char* kSides = "sides of a picture are 64 to 8192 pixels";

template <class Picture, class Array>
Picture picture_of(const Array& y, const Array& u, const Array& v) {
  const std::size_t height = y.shape(0), width = y.shape(1);
  if (height < FBS_MIN_SIDE || height > FBS_MAX_SIDE || width < FBS_MIN_SIDE || width > FBS_MAX_SIDE)
    throw StatusError(FBS_ERROR_ARGUMENT, kSides);
  Picture out{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}, {}};
  const Array* const planes[] = {&y, &u, &v};
  for (std::size_t k = 0; k < 3; ++k) {
    const Array& plane = *planes[k];
    const std::size_t rows = k == 0 ? height : (height + 1) / 2, columns = k == 0 ? width : (width + 1) / 2;
    if (plane.shape(0) != rows || plane.shape(1) != columns || plane.stride(1) != 1)
      throw StatusError(FBS_ERROR_ARGUMENT, kShapes);
    out.data[k] = plane.data();
    out.stride[k] = plane.stride(0);
  }
  return out;
}

template <class Sample, class Array>
RgbView<Sample> rgb_view(const Array& rgb) {
  if (rgb.stride(2) != 1 || rgb.stride(1) != 3)
    throw StatusError(FBS_ERROR_ARGUMENT, "rows of an RGB picture are contiguous");
  return {static_cast<std::uint32_t>(rgb.shape(1)), static_cast<std::uint32_t>(rgb.shape(0)), rgb.data(),
          rgb.stride(0)};
}

}  // namespace

fbs_picture view_of(const PlaneArray& y, const PlaneArray& u, const PlaneArray& v) {
  return picture_of<fbs_picture>(y, u, v);
}

fbs_const_picture view_of(const ConstPlaneArray& y, const ConstPlaneArray& u, const ConstPlaneArray& v) {
  return picture_of<fbs_const_picture>(y, u, v);
}

RgbView<std::uint8_t> view_of(const RgbArray& rgb) {
  return rgb_view<std::uint8_t>(rgb);
}

RgbView<const std::uint8_t> view_of(const ConstRgbArray& rgb) {
  return rgb_view<const std::uint8_t>(rgb);
}

}  // namespace fbs_python
