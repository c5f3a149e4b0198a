// Tuned constants of the adaptation. Lengths are in eye distances unless stated otherwise; values were set by
// eye on the first pictures of the ten clips unless stated otherwise.
#pragma once

namespace fbs::find_tuning {

constexpr int kMaxElasticIterations = 80;
/// The Gaussian narrows so that the whole face moves first and details last. The first sigma sets how much of
/// the face follows a mark, the last how fine a detail a single mark moves.
constexpr double kFirstElasticSigma = 0.55, kLastElasticSigma = 0.035, kElasticDecay = 0.93;
constexpr double kAtRest = 1.0 / 512;   ///< largest force that counts as rest
constexpr double kMinReach = 1.0 / 64;  ///< share of a folding iteration below which it is given up
constexpr double kMinArea = 0.05;       ///< share of a triangle's own area on the scaled head; less is a fold
constexpr double kMaxMarkedTangent = 0.6;                   ///< of a yaw estimated from marks
constexpr double kMarkSigma = 0.06, kMarkedYawSigma = 0.6;  ///< of a mark; of the yaw's tangent before any
constexpr double kMinHeadScale = 0.7, kMaxHeadScale = 1.4;  ///< anatomical limits of width and height
constexpr int kWidthIterations = 5;
constexpr double kMinEyeDistancePx = 4;
constexpr double kMaxMarkPx = 1e5;  ///< limit of a coordinate, either way: beyond every picture

}  // namespace fbs::find_tuning
