#include "cli/display/pattern_tint.h"

#include <algorithm>
#include <limits>

#include "decoder/draw/renderer.h"

namespace fbs::cli {
namespace {

// 0xRRGGBB. Each is as far as possible in CIELAB from all before it, so that a few patterns get the most
// distinct colours: none of the first 8 are closer than 67, none of all closer than 32. Lightness is at least
// 52 and chroma at least 40, since dark or grey colours do not tint.
constexpr std::array<std::uint32_t, kPatternColourCount> kColours = {
    0xee88bb, 0x00ff00, 0xffbb00, 0x00ffff, 0xcc11ff, 0xff0022, 0x559933, 0x0088ff,
    0xbb6633, 0xccee00, 0xff11bb, 0x00ff99, 0xeeee99, 0x00aadd, 0xee2266, 0xcc77ff,
    0xff7700, 0x998811, 0x009977, 0x00bb11, 0xbbaaff, 0xaaff77, 0xffbb88, 0x99eeaa};

/// A mouth seen wider open than any other, so that no mouth interior is drawn over it.
constexpr std::int32_t kWidestGap = std::numeric_limits<std::int32_t>::max() / 2;

Picture plain_picture(const Bgr& colour, const VideoFormat& format) {
  std::array<std::uint8_t, 12> four{};  // pixels of one chroma sample
  for (std::size_t i = 0; i < four.size(); ++i) four[i] = colour[i % colour.size()];
  const Picture sample = picture_from_rgb(four, 2, 2, format.range, format.matrix, ChannelOrder::kBgr);
  Picture out(format.width, format.height);
  std::ranges::fill(out.y.samples, sample.y.samples.front());
  std::ranges::fill(out.u.samples, sample.u.samples.front());
  std::ranges::fill(out.v.samples, sample.v.samples.front());
  return out;
}

/// A pattern of one colour with the position of this one, but without light.
Pattern painted(const Pattern& pattern, const Bgr& colour, const Scene& scene) {
  State unlit = pattern.seen;
  unlit.light = {};
  Pattern out = make_pattern(plain_picture(colour, scene.setup.format), unlit, scene.geometry);
  out.texture.mouth_gap = kWidestGap;
  return out;
}

}  // namespace

Bgr pattern_colour(std::size_t number) {
  const std::uint32_t colour = kColours[number % kColours.size()];
  return {static_cast<std::uint8_t>(colour), static_cast<std::uint8_t>(colour >> 8),
          static_cast<std::uint8_t>(colour >> 16)};
}

Result<RgbImage> pattern_tint(const Scene& scene, const State& state, std::span<const std::size_t> in_slot) {
  const VideoFormat& format = scene.setup.format;
  Scene colours{scene.setup, scene.geometry, {}};
  for (std::size_t slot = 0; slot < scene.patterns.size(); ++slot)
    colours.patterns.push_back(painted(scene.patterns[slot], pattern_colour(in_slot[slot]), scene));
  State unlit = state;
  unlit.light = {};
  Picture drawn;
  if (auto rendered = Renderer().render(colours, unlit, drawn); !rendered) return fail(rendered.error());
  return rgb_from_picture(drawn, format.range, format.matrix, ChannelOrder::kBgr);
}

}  // namespace fbs::cli
