// Pictures inside the codec: 8-bit planar 4:2:0, and the format of a whole video.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fbs {

inline constexpr int kMinPictureSize = 64;    ///< width and height, pixels
inline constexpr int kMaxPictureSize = 8192;  ///< width and height, pixels

inline constexpr std::int64_t kTicksPerSecond = 90000;  ///< unit of times and durations of pictures

/// One plane of 8-bit samples, rows top to bottom without padding.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> samples;  ///< width * height

  Plane() = default;
  Plane(int w, int h, std::uint8_t value = 0)
      : width(w), height(h), samples(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  [[nodiscard]] std::uint8_t* row(int y) {
    assert(y >= 0 && y < height);
    return samples.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  [[nodiscard]] const std::uint8_t* row(int y) const {
    assert(y >= 0 && y < height);
    return samples.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// A 4:2:0 picture. Chroma planes are (width + 1) / 2 by (height + 1) / 2; their samples lie at the centre of
/// the four luma samples they belong to. Samples use the range and matrix of the video.
struct Picture {
  Plane y, u, v;

  Picture() = default;
  Picture(int width, int height)
      : y(width, height),
        u((width + 1) / 2, (height + 1) / 2, 128),
        v((width + 1) / 2, (height + 1) / 2, 128) {}

  [[nodiscard]] int width() const { return y.width; }
  [[nodiscard]] int height() const { return y.height; }
  [[nodiscard]] bool empty() const { return y.samples.empty(); }
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// Samples of a plane in memory of any owner.
struct PlaneView {
  std::uint8_t* data = nullptr;  ///< first sample of the top row
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;  ///< samples from one row to the next

  PlaneView() = default;
  PlaneView(std::uint8_t* samples, int w, int h, std::ptrdiff_t row_stride)
      : data(samples), width(w), height(h), stride(row_stride) {}
  PlaneView(Plane& plane)  // NOLINT(google-explicit-constructor): a plane views its own memory
      : PlaneView(plane.samples.data(), plane.width, plane.height, plane.width) {}

  [[nodiscard]] std::uint8_t* row(int y) const {
    assert(y >= 0 && y < height);
    return data + y * stride;
  }
};

/// The read-only counterpart.
struct ConstPlaneView {
  const std::uint8_t* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;

  ConstPlaneView() = default;
  ConstPlaneView(const std::uint8_t* samples, int w, int h, std::ptrdiff_t row_stride)
      : data(samples), width(w), height(h), stride(row_stride) {}
  ConstPlaneView(const Plane& plane)  // NOLINT(google-explicit-constructor)
      : ConstPlaneView(plane.samples.data(), plane.width, plane.height, plane.width) {}
  ConstPlaneView(PlaneView view)  // NOLINT(google-explicit-constructor)
      : ConstPlaneView(view.data, view.width, view.height, view.stride) {}

  [[nodiscard]] const std::uint8_t* row(int y) const {
    assert(y >= 0 && y < height);
    return data + y * stride;
  }
};

/// A picture in memory of any owner, sizes as in Picture.
struct PictureView {
  PlaneView y, u, v;

  PictureView() = default;
  PictureView(PlaneView luma, PlaneView first_chroma, PlaneView second_chroma)
      : y(luma), u(first_chroma), v(second_chroma) {}
  PictureView(Picture& picture)  // NOLINT(google-explicit-constructor)
      : y(picture.y), u(picture.u), v(picture.v) {}
};

struct Rational {
  std::uint32_t num = 0;
  std::uint32_t den = 1;
  friend bool operator==(const Rational&, const Rational&) = default;
};

enum class ColourRange : std::uint8_t { kLimited = 0, kFull = 1 };
enum class ColourMatrix : std::uint8_t { kUnspecified = 0, kBt601 = 1, kBt709 = 2 };

/// Properties shared by all pictures of a video.
struct VideoFormat {
  int width = 0;                ///< pixels, kMinPictureSize..kMaxPictureSize
  int height = 0;               ///< pixels, kMinPictureSize..kMaxPictureSize
  Rational frame_rate{25, 1};   ///< pictures per second
  Rational pixel_aspect{1, 1};  ///< width of a pixel over its height; 0/1 when unknown
  ColourRange range = ColourRange::kLimited;
  ColourMatrix matrix = ColourMatrix::kUnspecified;
  friend bool operator==(const VideoFormat&, const VideoFormat&) = default;
};

}  // namespace fbs
