#include "cli/video/colour.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "cli/video/dither.h"

namespace fbs {
namespace {

constexpr int kShift = 16;
constexpr int kHalf = 1 << (kShift - 1);

constexpr int fixed(double value) {
  return static_cast<int>(value * (1 << kShift) + (value < 0 ? -0.5 : 0.5));
}

std::uint8_t clip(int value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
}

/// Weights of the luma equation Y = kr R + (1 - kr - kb) G + kb B.
struct LumaWeights {
  double kr, kb;
};

LumaWeights luma_weights(ColourMatrix matrix) {
  return matrix == ColourMatrix::kBt709 ? LumaWeights{0.2126, 0.0722} : LumaWeights{0.299, 0.114};
}

/// Black level and swing of the stored samples.
struct SampleRange {
  int black;
  double luma, chroma;  ///< levels between black and white, and between the chroma extremes
};

SampleRange sample_range(ColourRange range) {
  return range == ColourRange::kFull ? SampleRange{0, 255, 255} : SampleRange{16, 219, 224};
}

/// Factors of R = Y + cr_r Cr, G = Y + cb_g Cb + cr_g Cr, B = Y + cb_b Cb in 16.16.
struct ToRgb {
  int black, luma, cr_r, cb_g, cr_g, cb_b;

  ToRgb(ColourRange range, ColourMatrix matrix) {
    const auto [kr, kb] = luma_weights(matrix);
    const SampleRange levels = sample_range(range);
    const double kg = 1 - kr - kb;
    const double chroma = 255 / levels.chroma;
    black = levels.black;
    luma = fixed(255 / levels.luma);
    cr_r = fixed(2 * (1 - kr) * chroma);
    cb_b = fixed(2 * (1 - kb) * chroma);
    cr_g = fixed(-2 * (1 - kr) * kr / kg * chroma);
    cb_g = fixed(-2 * (1 - kb) * kb / kg * chroma);
  }
};

/// Rows of the matrix RGB to Y, Cb, Cr in 16.16.
struct FromRgb {
  int black;
  int y_r, y_g, y_b, cb_r, cb_g, cb_b, cr_r, cr_g, cr_b;

  FromRgb(ColourRange range, ColourMatrix matrix) {
    const auto [kr, kb] = luma_weights(matrix);
    const SampleRange levels = sample_range(range);
    const double kg = 1 - kr - kb;
    const double luma = levels.luma / 255;
    const double cb = levels.chroma / 255 / (2 * (1 - kb));
    const double cr = levels.chroma / 255 / (2 * (1 - kr));
    black = levels.black;
    y_r = fixed(kr * luma);
    y_b = fixed(kb * luma);
    y_g = fixed(luma) - y_r - y_b;  // so that white is exact
    cb_r = fixed(-kr * cb);
    cb_g = fixed(-kg * cb);
    cb_b = -cb_r - cb_g;  // so that grey is exact
    cr_g = fixed(-kg * cr);
    cr_b = fixed(-kb * cr);
    cr_r = -cr_g - cr_b;
  }
};

/// @param red  place of red in a pixel's three samples: 0 or 2
template <class Sample>
Picture from_rgb(std::span<const Sample> rgb, int width, int height, const FromRgb& m, int red) {
  assert(rgb.size() == 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  constexpr bool kWide = sizeof(Sample) > 1;
  using Sum = std::conditional_t<kWide, std::int64_t, int>;
  constexpr Sum kUnit = Sum{std::numeric_limits<Sample>::max()} / 255 << kShift;  // a level
  const auto rounding = [](int x, int y, Sum unit) { return kWide ? dither(x, y, unit) : unit / 2; };
  Picture picture(width, height);
  const int blue = 2 - red;
  const std::size_t stride = 3 * static_cast<std::size_t>(width);

  const Sample* in = rgb.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, in += 3) {
      const Sum sum = Sum{m.y_r} * in[red] + Sum{m.y_g} * in[1] + Sum{m.y_b} * in[blue];
      picture.y.row(y)[x] = clip(m.black + static_cast<int>((sum + rounding(x, y, kUnit)) / kUnit));
    }
  }

  for (int cy = 0; cy < picture.u.height; ++cy) {
    const Sample* upper = rgb.data() + static_cast<std::size_t>(2 * cy) * stride;
    const Sample* lower = 2 * cy + 1 < height ? upper + stride : upper;
    for (int cx = 0; cx < picture.u.width; ++cx) {
      const int left = 6 * cx;
      const int right = 2 * cx + 1 < width ? left + 3 : left;
      const auto four = [&](int c) {
        return Sum{upper[left + c]} + upper[right + c] + lower[left + c] + lower[right + c];
      };
      const Sum r = four(red);
      const Sum g = four(1);
      const Sum b = four(blue);
      const auto level = [&](Sum sum) {  // at least 0 before the division, which so rounds down
        return clip(static_cast<int>((512 * kUnit + sum + rounding(cx, cy, 4 * kUnit)) / (4 * kUnit)));
      };
      picture.u.row(cy)[cx] = level(m.cb_r * r + m.cb_g * g + m.cb_b * b);
      picture.v.row(cy)[cx] = level(m.cr_r * r + m.cr_g * g + m.cr_b * b);
    }
  }
  return picture;
}

}  // namespace

RgbImage rgb_from_picture(const Picture& picture, ColourRange range, ColourMatrix matrix,
                          ChannelOrder order) {
  const ToRgb m(range, matrix);
  RgbImage image{picture.width(), picture.height(), {}};
  image.samples.resize(3 * picture.y.samples.size());
  const int red = order == ChannelOrder::kRgb ? 0 : 2;
  const int blue = 2 - red;

  std::uint8_t* out = image.samples.data();
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* luma = picture.y.row(y);
    const std::uint8_t* cb_row = picture.u.row(y / 2);
    const std::uint8_t* cr_row = picture.v.row(y / 2);
    for (int x = 0; x < image.width; ++x, out += 3) {
      const int grey = (luma[x] - m.black) * m.luma + kHalf;
      const int cb = cb_row[x / 2] - 128;
      const int cr = cr_row[x / 2] - 128;
      out[red] = clip((grey + m.cr_r * cr) >> kShift);
      out[1] = clip((grey + m.cb_g * cb + m.cr_g * cr) >> kShift);
      out[blue] = clip((grey + m.cb_b * cb) >> kShift);
    }
  }
  return image;
}

Picture picture_from_rgb(std::span<const std::uint8_t> rgb, int width, int height, ColourRange range,
                         ColourMatrix matrix, ChannelOrder order) {
  return from_rgb(rgb, width, height, FromRgb(range, matrix), order == ChannelOrder::kRgb ? 0 : 2);
}

Picture picture_from_rgb(std::span<const std::uint16_t> rgb, int width, int height, ColourRange range,
                         ColourMatrix matrix) {
  return from_rgb(rgb, width, height, FromRgb(range, matrix), 0);
}

}  // namespace fbs
