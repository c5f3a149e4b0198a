// Tuned constants of head tracking, set by eye on the ten clips unless a figure is given.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "common/generic_head.h"
#include "encoder/image/work_frame.h"

namespace fbs::head_tuning {

// --- Appearance: the points compared ---

constexpr double kPointSpacing = 3;  ///< work pixels: precision against time
/// Weights of points on lips, eyes, brows and chin, which move by themselves, and of hair and forehead, which
/// are not where the mesh has them; others weigh 1.
constexpr float kMovingWeight = 0.8F, kHairWeight = 0.2F;
constexpr int kForeheadAbove = -kUnitsPerEyeDistance * 6 / 10;  ///< y in the head frame
constexpr double kMinCorrelationWeight = 20;  ///< sum of weights; fewer points prove nothing

// --- Levelled frames: brightness less its local mean, over the local contrast ---

constexpr double kLevellingReach = 0.22 * WorkFrame::kWorkEyeDistance;  ///< sigma of the local mean, pixels
constexpr double kMinLocalContrast = 6;  ///< grey levels; less is noise and stays flat
constexpr double kLevelledSigma = 40;    ///< grey levels that one local standard deviation becomes

// --- Flow from picture to picture ---

constexpr int kFlowWindow = 13;  ///< pixels; on the coarsest of the three levels an eye distance
/// Robust fit of the pose to the flow, eye distances: first and last outlier scale, and its decay.
constexpr double kFirstFlowSigma = 0.08, kLastFlowSigma = 0.02, kFlowSigmaDecay = 0.7;
constexpr int kFlowIterations = 8;
/// Prior of the pose about the picture before: rad (log2 for scale), eye distances.
constexpr double kFlowAngleSigma = 0.3, kFlowShiftSigma = 0.5;

// --- Alignment to picture 0 ---

constexpr std::array<std::size_t, 3> kEveryPoint = {1, 2, 4};  ///< one point of this many; finest level first
constexpr int kAlignmentIterations = 6;
constexpr double kAlignmentAngleSigma = 0.5, kAlignmentShiftSigma = 0.5;  ///< as above
constexpr float kResidualVariance = 25;                                   ///< squared grey levels
/// Outlier scale, grey levels: at first, and the range of 2.5 times the mean absolute residual after.
constexpr double kFirstOutlier = 20, kMinOutlier = 6, kMaxOutlier = 30, kOutlierPerMean = 2 * 1.25;
/// Light changes slowly: inverse variances of gain and offset, and their range.
constexpr double kGainPrecision = 1e4, kOffsetPrecision = 1e-1;
constexpr double kMinGain = 0.5, kMaxGain = 2, kMaxOffset = 80;
constexpr float kMinPoints = 50;     ///< on the finest level; with fewer the pose stays
constexpr double kConverged = 5e-4;  ///< sum of a step's angles, rad, and shift, eye distances
constexpr double kMayLose = 0.002;   ///< correlation that a finer level may lose

// --- Loss and search: correlations, which depend on each other ---

/// Highest correlation of other people and pictures upside down. Measured; changes with points, weights or
/// levelling, and kLostBelow with it.
constexpr double kImpostorsReach = 0.53;
/// A pose below this is rejected: the head is lost. Trades following an impostor, whose reach it must exceed,
/// against losing the right head.
constexpr double kLostBelow = 0.55;
/// Required for a head found elsewhere or at another size, where an impostor is likelier.
constexpr double kSureFrom = 0.6;
/// In another shot, HeadAppearance::colour_difference() of another person. Correlation alone is too little
/// there: of 300 cuts between 151 faces, at up to twice each other's size, 36 reach kSureFrom, and one of
/// these is below this; of 169 returns of 16 people to other pictures of theirs, framed as differently, 167
/// are.
constexpr double kStrangersColour = 8;
/// Below this, the tracker also tries the frontal pose. Above kSureFrom: what passes is not questioned again.
constexpr double kDoubtBelow = 0.7;
static_assert(kImpostorsReach < kLostBelow && kLostBelow < kSureFrom && kSureFrom < kDoubtBelow);
/// Candidates worth refining: at the coarsest level, and where the head was. Far below kLostBelow, since
/// refining raises a correlation.
constexpr double kWorthRefining = 0.35, kWorthRefiningInPlace = 0.1;
static_assert(kWorthRefining < kLostBelow);

constexpr int kEverywherePeriod = 2;  ///< lost pictures from one search of the whole picture to the next
constexpr std::size_t kRefinedCandidates = 2;  ///< best of a grid; each costs an alignment
constexpr double kMaxSizeChange = 0.5;         ///< log2, against the last good pose
constexpr double kMaxFramingChange = 1.2;      ///< the same in another shot, nearer or farther
constexpr double kMaxTurn = 0.9;               ///< rad of yaw or pitch; beyond, hardly a face is visible
constexpr double kMinInside = 0.7;             ///< share of the head's points inside the picture
constexpr double kFlatDeviation = 4;           ///< grey levels of standard deviation: nothing to see
constexpr double kDegree = std::numbers::pi / 180;
/// Poses so near that both refine to the same: eye distances, rad of yaw or pitch.
constexpr double kSamePlace = 0.25, kSameTurn = 20 * kDegree;
/// A head that has not moved: eye distances, log2 of its size.
constexpr double kStayedPlace = 0.3, kStayedSize = 0.15;

}  // namespace fbs::head_tuning
