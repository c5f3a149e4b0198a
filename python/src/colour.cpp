#include "colour.h"

#include <algorithm>
#include <cmath>

#include "status_error.h"

namespace nb = nanobind;

namespace fbs_python {
namespace {

constexpr int kShift = 16;  ///< of fixed-point numbers; sums of a pixel stay below 2^27

int fixed(double value) {
  return static_cast<int>(std::lround(value * (1 << kShift)));
}

std::uint8_t to_byte(int value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
}

/// ITU-R BT.601 or BT.709: Y = red R + green G + blue B; chroma is the excess of R and B over Y, scaled to
/// one half.
struct Equation {
  explicit Equation(const Colours& colours)
      : red(colours.matrix == FBS_MATRIX_BT709 ? 0.2126 : 0.299),
        blue(colours.matrix == FBS_MATRIX_BT709 ? 0.0722 : 0.114),
        green(1 - red - blue),
        black(colours.full_range ? 0 : 16),
        luma_levels(colours.full_range ? 255 : 219),
        chroma_levels(colours.full_range ? 255 : 224) {}

  double red, blue, green;
  int black;
  double luma_levels, chroma_levels;  ///< of 255 levels of R, G and B
};

/// Converts planes and pixels of one picture, both of the same size.
template <class Picture, class Sample>
void require_same_size(const Picture& picture, const RgbView<Sample>& rgb) {
  if (picture.width != rgb.width || picture.height != rgb.height)
    throw StatusError(FBS_ERROR_ARGUMENT, "the RGB picture and the planes differ in size");
}

}  // namespace

void rgb_of(const fbs_const_picture& picture, const Colours& colours, const RgbView<std::uint8_t>& out) {
  const Equation e(colours);
  const int luma = fixed(255 / e.luma_levels);
  const double chroma = 255 / e.chroma_levels;
  const int red_of_cr = fixed(2 * (1 - e.red) * chroma), blue_of_cb = fixed(2 * (1 - e.blue) * chroma);
  const int green_of_cr = fixed(-2 * (1 - e.red) * e.red / e.green * chroma);
  const int green_of_cb = fixed(-2 * (1 - e.blue) * e.blue / e.green * chroma);
  for (std::uint32_t row = 0; row < out.height; ++row) {
    const std::uint8_t* const y = picture.data[0] + row * picture.stride[0];
    const std::uint8_t* const u = picture.data[1] + row / 2 * picture.stride[1];
    const std::uint8_t* const v = picture.data[2] + row / 2 * picture.stride[2];
    std::uint8_t* pixel = out.data + row * out.stride;
    for (std::uint32_t x = 0; x < out.width; ++x, pixel += 3) {
      const int grey = (y[x] - e.black) * luma + (1 << (kShift - 1));
      const int cb = u[x / 2] - 128, cr = v[x / 2] - 128;
      pixel[0] = to_byte((grey + red_of_cr * cr) >> kShift);
      pixel[1] = to_byte((grey + green_of_cb * cb + green_of_cr * cr) >> kShift);
      pixel[2] = to_byte((grey + blue_of_cb * cb) >> kShift);
    }
  }
}

void planes_of(const RgbView<const std::uint8_t>& rgb, const Colours& colours, const fbs_picture& out) {
  const Equation e(colours);
  const double luma = e.luma_levels / 255;
  const int y_red = fixed(e.red * luma), y_blue = fixed(e.blue * luma);
  const int y_green = fixed(luma) - y_red - y_blue;  // white is exact
  for (std::uint32_t row = 0; row < rgb.height; ++row) {
    const std::uint8_t* pixel = rgb.data + row * rgb.stride;
    std::uint8_t* const y = out.data[0] + row * out.stride[0];
    for (std::uint32_t x = 0; x < rgb.width; ++x, pixel += 3) {
      const int sum = y_red * pixel[0] + y_green * pixel[1] + y_blue * pixel[2];
      y[x] = to_byte(e.black + ((sum + (1 << (kShift - 1))) >> kShift));
    }
  }

  const double cb = e.chroma_levels / 255 / (2 * (1 - e.blue)),
               cr = e.chroma_levels / 255 / (2 * (1 - e.red));
  const int cb_red = fixed(-e.red * cb), cb_green = fixed(-e.green * cb),
            cb_blue = -cb_red - cb_green;  // grey is exact
  const int cr_green = fixed(-e.green * cr), cr_blue = fixed(-e.blue * cr), cr_red = -cr_green - cr_blue;
  const auto level = [](int sum_of_four) {
    return to_byte(128 + ((sum_of_four + (1 << (kShift + 1))) >> (kShift + 2)));
  };
  for (std::uint32_t row = 0; row < (rgb.height + 1) / 2; ++row) {
    const std::uint8_t* const upper = rgb.data + 2 * row * rgb.stride;
    const std::uint8_t* const lower = 2 * row + 1 < rgb.height ? upper + rgb.stride : upper;
    for (std::uint32_t x = 0; x < (rgb.width + 1) / 2; ++x) {
      const std::uint32_t left = 6 * x, right = 2 * x + 1 < rgb.width ? left + 3 : left;
      const auto four = [&](std::uint32_t c) {
        return upper[left + c] + upper[right + c] + lower[left + c] + lower[right + c];
      };
      const int r = four(0), g = four(1), b = four(2);
      out.data[1][row * out.stride[1] + x] = level(cb_red * r + cb_green * g + cb_blue * b);
      out.data[2][row * out.stride[2] + x] = level(cr_red * r + cr_green * g + cr_blue * b);
    }
  }
}

void bind_colour(nb::module_& module) {
  module.def(
      "rgb_from_planes",
      [](const ConstPlaneArray& y, const ConstPlaneArray& u, const ConstPlaneArray& v, const RgbArray& out,
         int matrix, bool full_range) {
        const fbs_const_picture picture = view_of(y, u, v);
        const RgbView<std::uint8_t> rgb = view_of(out);
        require_same_size(picture, rgb);
        const nb::gil_scoped_release others;
        rgb_of(picture, {static_cast<fbs_matrix>(matrix), full_range}, rgb);
      },
      nb::arg("y"), nb::arg("u"), nb::arg("v"), nb::arg("out"), nb::arg("matrix"), nb::arg("full_range"));
  module.def(
      "planes_from_rgb",
      [](const ConstRgbArray& rgb, const PlaneArray& y, const PlaneArray& u, const PlaneArray& v, int matrix,
         bool full_range) {
        const RgbView<const std::uint8_t> in = view_of(rgb);
        const fbs_picture picture = view_of(y, u, v);
        require_same_size(picture, in);
        const nb::gil_scoped_release others;
        planes_of(in, {static_cast<fbs_matrix>(matrix), full_range}, picture);
      },
      nb::arg("rgb"), nb::arg("y"), nb::arg("u"), nb::arg("v"), nb::arg("matrix"), nb::arg("full_range"));
}

}  // namespace fbs_python
