#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cli/video/colour.h"
#include "cli/video/images/image_files.h"

namespace fbs {
namespace {

constexpr int kChannels = 3;

/// The first line of OpenImageIO's error.
std::string reason_of(const std::string& error) {
  return error.empty() ? "damaged image" : error.substr(0, error.find('\n'));
}

/// Floating-point files that name no colour space hold linear light.
bool is_linear(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (space.empty()) return spec.format.is_floating_point();
  return OIIO::Strutil::istarts_with(space, "lin") || OIIO::Strutil::iequals(space, "scene_linear");
}

/// IEC 61966-2-1. Never returns infinities or NaN.
float srgb_of(float linear) {
  if (!(linear > 0)) return 0;
  const float v = std::min(linear, 1.0F);
  return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
}

/// @param samples  of 1 or 3 channels, linear light or of sRGB's curve
template <class Sample>
Picture picture_of(std::span<const float> samples, bool linear, std::size_t channels,
                   const VideoFormat& format) {
  constexpr Sample kWhite = std::numeric_limits<Sample>::max();
  std::vector<Sample> rgb(samples.size() / channels * kChannels);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float v = samples[channels == 1 ? i / kChannels : i];
    const float srgb = linear ? srgb_of(v) : v;
    rgb[i] = srgb > 0 ? static_cast<Sample>(std::lround(kWhite * std::min(srgb, 1.0F))) : Sample{0};
  }
  return picture_from_rgb(std::span<const Sample>(rgb), format.width, format.height, format.range,
                          format.matrix);
}

}  // namespace

Result<Picture> read_still_image(const std::string& name, const VideoFormat& format) {
  const auto image = OIIO::ImageInput::open(name);
  if (!image) return fail(ErrorCode::kIo, "cannot read " + name + ": " + reason_of(OIIO::geterror()));
  const OIIO::ImageSpec& spec = image->spec();
  if (spec.width != format.width || spec.height != format.height) {
    return fail(ErrorCode::kInvalidArgument,
                name + ": is " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                    ", the video " + std::to_string(format.width) + "x" + std::to_string(format.height));
  }
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const auto channels = static_cast<std::size_t>(spec.nchannels >= kChannels ? kChannels : 1);
  std::vector<float> samples(pixels * channels);
  if (!image->read_image(0, 0, 0, static_cast<int>(channels), OIIO::TypeDesc::FLOAT, samples.data()))
    return fail(ErrorCode::kInvalidStream, "cannot read " + name + ": " + reason_of(image->geterror()));
  return spec.format.basesize() > 1 ? picture_of<std::uint16_t>(samples, is_linear(spec), channels, format)
                                    : picture_of<std::uint8_t>(samples, is_linear(spec), channels, format);
}

}  // namespace fbs
