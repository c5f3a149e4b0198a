#include "encoder/plan/pattern_point.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fbs {
namespace {

/// Points on the convex hull of rate and distortion, at qualities 0, 25, 50, 75 and 100; measured on the ten
/// clips.
struct HullPoint {
  double per_second, quantiser, motion_quality;
};
using Hull = std::array<HullPoint, 5>;
constexpr Hull kHull = {{{0.4, 63, 20}, {0.8, 60, 25}, {1.6, 58, 38}, {3.2, 55, 38}, {5.6, 52, 45}}};

/// The same for pictures without a face: highway and hall_monitor, which differ. Up to 12 kbit/s more
/// patterns gain more than finer ones; beyond, every picture of a busy scene should become one.
constexpr Hull kHullWithoutFace = {{{1.5, 63, 20}, {4, 62, 25}, {7, 60, 38}, {13, 58, 38}, {30, 54, 45}}};

/// Contrast of patterns outside the face. Against full contrast, kPsnr's takes 3.5 % fewer bytes in the face
/// at the same PSNR, and hardly more in the frame. kEye's goes on from there at the same mean rate: colours
/// of mouth and eyes are 5 % nearer to the source, SSIM there rises by .007, false edges fall by a tenth, and
/// the frame loses 0.13 dB (ten clips at quality 50).
constexpr std::int32_t kPsnrContrast = 220, kEyeContrast = 170;
/// Contrast of patterns' chroma. Against none, kEye's takes 5 % more bytes, and colours of mouth and eyes are
/// 11 and 7 % nearer to the source (ten clips at quality 50).
constexpr std::int32_t kPsnrChroma = 320, kEyeChroma = 384;
/// Steps of the quantiser for which the bytes that kEyeContrast saves pay.
constexpr int kFinerByEye = 2;

/// Increase of the quantiser for twice the samples: blends of large pictures favour more patterns with fewer
/// bits each. Without it 720x1280 loses 12 % of its bytes, 176x144 some 3 %.
constexpr double kStepsPerOctave = 1.4;

/// AV1's step of 8-bit AC coefficients at libaom's quantiser 63, levels, and the logarithm of its ratio from
/// one quantiser to the next near there.
constexpr double kCoarsestStep = 228, kLogStep = 0.088;

/// Lambda as a share of the squared step. Some 0.15 is usual for video; here errors add up until a pattern is
/// bought, and each pattern serves all later pictures.
constexpr double kShare = 1.6;

PatternPoint on(const Hull& hull, int quality) {
  const double place = std::clamp(quality, 0, 100) / 25.0;
  const auto below = std::min(static_cast<std::size_t>(place), hull.size() - 2);
  const double share = place - static_cast<double>(below);
  const HullPoint &a = hull[below], &b = hull[below + 1];
  return {a.per_second * std::pow(b.per_second / a.per_second, share),
          static_cast<int>(std::lround(a.quantiser + share * (b.quantiser - a.quantiser))),
          static_cast<int>(std::lround(a.motion_quality + share * (b.motion_quality - a.motion_quality)))};
}

}  // namespace

PatternPoint PatternPoint::at(int quality) {
  return on(kHull, quality);
}

PatternPoint PatternPoint::by_eye(int quality) {
  PatternPoint p = at(quality);
  p.quantiser -= kFinerByEye;
  return p;
}

PatternPoint PatternPoint::without_face(int quality) {
  return on(kHullWithoutFace, quality);
}

std::int32_t surround_contrast(Tune tune) {
  return tune == Tune::kEye ? kEyeContrast : kPsnrContrast;
}

std::int32_t chroma_contrast(Tune tune) {
  return tune == Tune::kEye ? kEyeChroma : kPsnrChroma;
}

int quantiser_of(const PatternPoint& point, int width, int height) {
  const double octaves = std::log2(static_cast<double>(width) * height / (352 * 288));
  return std::clamp(static_cast<int>(std::lround(point.quantiser + kStepsPerOctave * octaves)), 0, 63);
}

double pattern_lambda(int quantiser) {
  const double step = kCoarsestStep * std::exp(kLogStep * (quantiser - 63));
  return kShare * step * step;
}

int motion_quality_at(double kbps, bool live) {
  if (live) return std::clamp(static_cast<int>(std::lround(50 + 14 * std::log2(kbps / 6))), 0, 90);
  // From 20 at 1.7 kbit/s to 50 at 14, as on the hull for small pictures.
  return std::clamp(static_cast<int>(std::lround(20 + 10 * std::log2(kbps / 1.7))), 0, 50);
}

}  // namespace fbs
