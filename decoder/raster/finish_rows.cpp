#include "decoder/raster/finish_rows.h"

#include <algorithm>

namespace fbs {
namespace {

constexpr std::int64_t kMaxLightRow = std::int64_t{kMaxLight} << kLightOneLog2;

/// @param offset, gain  2^-8 of 1/16 grey level
std::uint8_t lit(std::int32_t luma, std::int32_t offset, std::int32_t gain) {
  const std::int32_t by_gain = (luma - 128) * gain >> 6;
  const std::int32_t sum = (luma << 12) + offset + by_gain;  // 2^-12 grey level
  return static_cast<std::uint8_t>(std::clamp((sum + (1 << 11)) >> 12, 0, 255));
}

bool within_max_light(const LinearRow& row, int count) {
  const auto within = [](std::int64_t v) { return v >= -kMaxLightRow && v <= kMaxLightRow; };
  return within(row.first) && within(row.at(count - 1));
}

}  // namespace

void light_row_clamped(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count) {
  const auto limited = [](std::int64_t v) {
    return static_cast<std::int32_t>(std::clamp(v, -kMaxLightRow, kMaxLightRow) >> 8);
  };
  for (int i = 0; i < count; ++i) luma[i] = lit(luma[i], limited(offset.at(i)), limited(gain.at(i)));
}

void light_row_inside(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count) {
  auto o = static_cast<std::int32_t>(offset.first), g = static_cast<std::int32_t>(gain.first);
  const auto o_step = static_cast<std::int32_t>(offset.step), g_step = static_cast<std::int32_t>(gain.step);
  for (int i = 0; i < count; ++i, o += o_step, g += g_step) luma[i] = lit(luma[i], o >> 8, g >> 8);
}

void light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count) {
  if (within_max_light(offset, count) && within_max_light(gain, count))
    light_row_inside(luma, offset, gain, count);
  else
    light_row_clamped(luma, offset, gain, count);
}

void mix_interior_row(std::uint8_t* samples, const std::array<std::uint8_t, kInteriorCount>& colours,
                      std::int32_t opacity, const LinearRow& ramp, int count) {
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::int32_t>(std::clamp<std::int64_t>(ramp.at(i) >> 16, 0, 256));
    const std::size_t upper = at < 128 ? 0 : 1;
    const std::int32_t share = at < 128 ? at : at - 128;  // of the lower of the two colours, 1/128
    const std::int32_t colour = (colours[upper] * (128 - share) + colours[upper + 1] * share + 64) >> 7;
    samples[i] = static_cast<std::uint8_t>((samples[i] * (256 - opacity) + colour * opacity + 128) >> 8);
  }
}

}  // namespace fbs
