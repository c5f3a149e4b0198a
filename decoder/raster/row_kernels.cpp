#include "decoder/raster/row_kernels.h"

#include <algorithm>

namespace fbs {
namespace {

constexpr std::int64_t kMaxLightRow = std::int64_t{kMaxLight} << kLightOneLog2;

std::uint8_t sample_clamped(const ConstPlaneView& p, std::int64_t u, std::int64_t v) {
  u = std::clamp<std::int64_t>(u, 0, std::int64_t{p.width - 1} << 16);
  v = std::clamp<std::int64_t>(v, 0, std::int64_t{p.height - 1} << 16);
  const int x0 = static_cast<int>(u >> 16), y0 = static_cast<int>(v >> 16);
  const int x1 = std::min(x0 + 1, p.width - 1), y1 = std::min(y0 + 1, p.height - 1);
  const std::uint8_t* top = p.row(y0);
  const std::uint8_t* bottom = p.row(y1);
  return bilinear(top[x0], top[x1], bottom[x0], bottom[x1], static_cast<std::int32_t>((u >> 8) & 255),
                  static_cast<std::int32_t>((v >> 8) & 255));
}

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

void sample_row_clamped(const ConstPlaneView& texture, const TextureRow& at, std::uint8_t* out, int count) {
  std::int64_t u = at.u.first, v = at.v.first;
  for (int i = 0; i < count; ++i, u += at.u.step, v += at.v.step) out[i] = sample_clamped(texture, u, v);
}

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

void weight_row(const LinearRow& weight, std::int16_t* left, std::int16_t* out, int count) {
  for (int i = 0; i < count; ++i) {
    out[i] = static_cast<std::int16_t>(std::clamp<std::int64_t>(weight.at(i) >> 16, 0, left[i]));
    left[i] = static_cast<std::int16_t>(left[i] - out[i]);
  }
}

void add_weighted_row(const std::uint8_t* samples, const std::int16_t* weights, std::int32_t* sum, int count) {
  for (int i = 0; i < count; ++i) sum[i] += samples[i] * weights[i];
}

void add_scaled_row(const std::uint8_t* samples, std::int32_t weight, std::int32_t* sum, int count) {
  for (int i = 0; i < count; ++i) sum[i] += samples[i] * weight;
}

void round_row(const std::int32_t* sum, std::uint8_t* out, int count) {
  for (int i = 0; i < count; ++i) out[i] = static_cast<std::uint8_t>(sum[i] >> kWeightOneLog2);
}

}  // namespace fbs
