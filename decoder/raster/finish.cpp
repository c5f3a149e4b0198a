#include "decoder/raster/finish.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace fbs {
namespace {

constexpr std::int64_t kMaxLightRow = std::int64_t{kMaxLight} << kLightOneLog2;

/// @param offset, gain  2^-8 of 1/16 grey level
std::uint8_t lit(std::int32_t luma, std::int32_t offset, std::int32_t gain) {
  const std::int32_t by_gain = (luma - 128) * gain >> 6;
  const std::int32_t sum = (luma << 12) + offset + by_gain;  // 2^-12 grey level
  return static_cast<std::uint8_t>(std::clamp((sum + (1 << 11)) >> 12, 0, 255));
}

/// The luma from which a light has made this.
std::uint8_t unlit(std::int32_t luma, std::int32_t offset, std::int32_t gain) {
  constexpr std::int32_t kOne = 1 << 18, kLeast = 1 << 16;
  const std::int64_t factor = std::max(kOne + gain, kLeast);
  const std::int64_t sum = (std::int64_t{luma - 128} << 18) - (std::int64_t{offset} << 6);
  constexpr std::int64_t kAbove = 1 << 11;  // makes the dividend positive
  const std::int64_t before = (sum + factor / 2 + kAbove * factor) / factor - kAbove;
  return static_cast<std::uint8_t>(std::clamp<std::int64_t>(128 + before, 0, 255));
}

/// The same for four samples, without the clamp.
/// @param by_gain  (luma - 128) * gain
SignedWideLanes lit(SignedWideLanes luma, SignedWideLanes offset, SignedWideLanes by_gain) {
  return ((luma << 12) + offset + (by_gain >> 6) + (1 << 11)) >> 12;
}

/// Whether all lanes lie within +-limit.
bool is_within(const LinearRow& row, std::int64_t limit) {
  const auto within = [&](std::int64_t v) { return v >= -limit && v <= limit; };
  return within(row.first) && within(row.at(kLaneCount - 1));
}

/// Whether all lanes need no clamp and do not overflow.
bool within_max_light(const LinearRow& row) {
  return is_within(row, kMaxLightRow);
}

/// Whether all lanes fit 16 bits. Usual gains do: up to 1/8 above and below one.
bool is_low(const LinearRow& gain) {
  return is_within(gain, std::int64_t{std::numeric_limits<std::int16_t>::max()} << 8);
}

std::array<SignedWideLanes, 2> lanes_of(const Gradient& g) {
  const auto step = static_cast<std::uint32_t>(g.dx);
  return {reinterpret_cast<SignedWideLanes>(WideLanes{0, 1, 2, 3} * step),
          reinterpret_cast<SignedWideLanes>(WideLanes{4, 5, 6, 7} * step)};
}

std::int32_t limited(std::int64_t v) {
  return static_cast<std::int32_t>(std::clamp(v, -kMaxLightRow, kMaxLightRow) >> 8);
}

}  // namespace

void take_back_light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count) {
  for (int i = 0; i < count; ++i) luma[i] = unlit(luma[i], limited(offset.at(i)), limited(gain.at(i)));
}

void light_row(std::uint8_t* luma, const LinearRow& offset, const LinearRow& gain, int count) {
  for (int i = 0; i < count; ++i) luma[i] = lit(luma[i], limited(offset.at(i)), limited(gain.at(i)));
}

LightPainter::LightPainter(const TriangleSetup& setup, const Light& light)
    : offset_(setup.gradient(light.offset, 0)),
      gain_(setup.gradient(light.gain, 0)),
      offset_lanes_(lanes_of(offset_)),
      gain_lanes_(lanes_of(gain_)) {}

Lanes LightPainter::take_back(const RowBlock<PlaneScale::kLuma>& block, Lanes luma) const {
  std::array<std::uint8_t, kLaneCount> row;
  store_lanes(luma, row.data());
  take_back_light_row(row.data(), block.along(offset_), block.along(gain_), block.count);
  return load_lanes(row.data());
}

Lanes LightPainter::paint(const RowBlock<PlaneScale::kLuma>& block, Lanes luma) const {
  const LinearRow offset = block.along(offset_), gain = block.along(gain_);
  if (!within_max_light(offset) || !within_max_light(gain)) {
    std::array<std::uint8_t, kLaneCount> row;
    store_lanes(luma, row.data());
    light_row(row.data(), offset, gain, block.count);
    return load_lanes(row.data());
  }
  std::array<SignedWideLanes, 2> halves = widen(luma), gains;
  for (std::size_t i = 0; i < halves.size(); ++i)
    gains[i] = (static_cast<std::int32_t>(gain.first) + gain_lanes_[i]) >> 8;
  const auto by_gain = is_low(gain) ? multiply_wide(reinterpret_cast<SignedLanes>(luma - 128), narrow(gains))
                                    : std::array{(halves[0] - 128) * gains[0], (halves[1] - 128) * gains[1]};
  for (std::size_t i = 0; i < halves.size(); ++i)
    halves[i] = lit(halves[i], (static_cast<std::int32_t>(offset.first) + offset_lanes_[i]) >> 8, by_gain[i]);
  return narrow_clamped(halves);
}

}  // namespace fbs
