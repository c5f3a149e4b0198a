// Converts between the video's own YCbCr 4:2:0 and RGB, for image files and the screen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/picture.h"

namespace fbs {

/// Red, green, blue, one byte each, rows top to bottom without padding.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> samples;  ///< 3 * width * height
};

/// Order of the three bytes of a pixel.
enum class ChannelOrder : std::uint8_t { kRgb, kBgr };

/// Converts with the range and matrix of the format (ITU-R BT.601 or BT.709, 16.16 fixed point).
/// ColourMatrix::kUnspecified counts as BT.601, as in ffmpeg. Each chroma sample serves its four pixels
/// unfiltered, so that picture_from_rgb restores the picture wherever RGB could hold it.
/// @param order  kBgr suits OpenCV
RgbImage rgb_from_picture(const Picture& picture, ColourRange range, ColourMatrix matrix,
                          ChannelOrder order = ChannelOrder::kRgb);

/// The inverse; chroma is the mean of the (up to) four pixels it belongs to.
/// @param rgb  3 * width * height bytes
Picture picture_from_rgb(std::span<const std::uint8_t> rgb, int width, int height, ColourRange range,
                         ColourMatrix matrix, ChannelOrder order = ChannelOrder::kRgb);

/// The same of samples of 16 bits, dithered (dither.h).
/// @param rgb  3 * width * height samples, 65535 is white; red comes first
Picture picture_from_rgb(std::span<const std::uint16_t> rgb, int width, int height, ColourRange range,
                         ColourMatrix matrix);

}  // namespace fbs
