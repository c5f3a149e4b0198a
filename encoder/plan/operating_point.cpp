#include "encoder/plan/operating_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fbs {
namespace {

std::int32_t step(double value) {
  return static_cast<std::int32_t>(std::clamp(std::lround(value), 1L, 4096L));
}

}  // namespace

OperatingPoint OperatingPoint::at(int quality, double eye_distance_px) {
  OperatingPoint p;
  p.pattern_quantiser = std::clamp(static_cast<int>(std::lround(66 - 0.52 * quality)), 2, 63);
  // A quarter of a pixel on a small face, half a pixel on one that fills a large picture. A step of rotation
  // or scale moves the farthest vertex, 1.3 eye distances from the origin, as far as a step of translation
  // moves all.
  const double px = 0.25 * std::sqrt(std::max(8.0, eye_distance_px) / 34) * std::exp2((50 - quality) / 25.0);
  const double turn = px / (1.3 * eye_distance_px) / (2 * std::numbers::pi);
  p.steps.translation = step(px * 64);
  p.steps.rotation = step(turn * 65536);
  p.steps.log_scale = step(px / (1.3 * eye_distance_px) / std::numbers::ln2 * 4096);
  p.steps.light = step(24 * std::exp2((50 - quality) / 25.0));
  p.steps.control = step(3.2 * px / eye_distance_px * kUnitsPerEyeDistance);
  // Lambda is proportional to the face's area, so that a bit buys the same change of PSNR on a face of any
  // size. Measured on the ten clips at quality 50: a quarter of this lambda adds a third of motion bits for
  // 0.1 dB in the face; four times as much saves a third for 0.3 dB, and shuts mouths.
  p.lambda = 4 * eye_distance_px * eye_distance_px * std::exp2((50 - quality) / 12.0);
  return p;
}

}  // namespace fbs
