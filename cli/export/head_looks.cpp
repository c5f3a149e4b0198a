#include "cli/export/head_looks.h"

#include <algorithm>

#include "cli/program/module.h"
#include "cli/video/colour.h"
#include "cli/video/video_modules.h"

namespace fbs::cli {
namespace {

RgbImage cropped(const RgbImage& image, const TextureArea& area) {
  RgbImage out{area.width, area.height, {}};
  for (int y = area.top; y < area.top + area.height; ++y) {
    const auto first = image.samples.begin() + 3 * (std::ptrdiff_t{y} * image.width + area.left);
    out.samples.insert(out.samples.end(), first, first + 3 * std::ptrdiff_t{area.width});
  }
  return out;
}

Srgb srgb_of(const YuvColour& colour, const VideoFormat& format) {
  Picture sample(1, 1);
  sample.y.samples = {colour.y};
  sample.u.samples = {colour.u};
  sample.v.samples = {colour.v};
  const RgbImage rgb = rgb_from_picture(sample, format.range, format.matrix);
  return {rgb.samples[0], rgb.samples[1], rgb.samples[2]};
}

}  // namespace

Result<std::vector<HeadLook>> make_head_looks(const HeadRecording& recording) {
  const auto encode_png = load_module_function<EncodePngFunction>(kAvModule, kEncodePngSymbol);
  if (!encode_png) return fail(encode_png.error());
  const VideoFormat& format = recording.format();
  std::vector<HeadLook> out;
  for (const RecordedHead& head : recording.heads()) {
    Result<std::vector<std::uint8_t>> png;
    const TextureArea area = texture_area(head);
    (*encode_png)(cropped(rgb_from_picture(head.pattern, format.range, format.matrix), area), area.width,
                  area.height, png);
    if (!png) return fail(png.error());
    HeadLook look{std::move(*png), {}};
    const auto colours = mouth_colours(head);
    for (std::size_t i = 0; i < colours.size(); ++i) look.mouth[i] = srgb_of(colours[i], format);
    out.push_back(std::move(look));
  }
  return out;
}

}  // namespace fbs::cli
