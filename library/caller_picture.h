// Pictures in a caller's memory, as described in fbs/fbs.h.
#pragma once

#include <cstddef>

#include "common/picture.h"
#include "fbs/fbs.h"

namespace fbs {

/// Width and height of a plane of a picture of this format.
struct PlaneSize {
  int width, height;
};
[[nodiscard]] inline PlaneSize plane_size(const VideoFormat& format, std::size_t plane) {
  if (plane == 0) return {format.width, format.height};
  return {(format.width + 1) / 2, (format.height + 1) / 2};
}

[[nodiscard]] inline fbs_format caller_format(const VideoFormat& format) {
  return {static_cast<uint32_t>(format.width),
          static_cast<uint32_t>(format.height),
          format.frame_rate.num,
          format.frame_rate.den,
          format.pixel_aspect.num,
          format.pixel_aspect.den,
          static_cast<fbs_matrix>(format.matrix),
          format.range == ColourRange::kFull ? 1 : 0};
}

/// What is wrong with a picture that is to have the format's size; null: nothing.
template <class CallerPicture>
[[nodiscard]] const char* fault_of(const CallerPicture& picture, const VideoFormat& format) {
  if (picture.width != static_cast<unsigned>(format.width) ||
      picture.height != static_cast<unsigned>(format.height))
    return "the picture has another size than the format";
  for (std::size_t k = 0; k < 3; ++k) {
    if (picture.data[k] == nullptr) return "a plane is null";
    const std::ptrdiff_t width = plane_size(format, k).width;
    if (picture.stride[k] < width && picture.stride[k] > -width)
      return "a stride is less than the width of its plane";
  }
  return nullptr;
}

}  // namespace fbs
