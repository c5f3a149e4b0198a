// Tuned constants of this room, set by eye on the ten clips unless a figure is given.
#pragma once

namespace fbs::surround {

// --- Keypoints and layers (surround_motion) ---

constexpr int kMotionLongSide = 256;    ///< work pixels: precision against time, which grows with the square
constexpr int kSquare = 4;              ///< work pixels; each gives one keypoint at most
constexpr float kMinSlope = 3;          ///< grey levels per work pixel; flatter squares show no displacement
constexpr float kMaxHeadPrior = 0.99F;  ///< of a keypoint; beyond, the head covers it and it is left out
constexpr double kMinWeight = 0.1;      ///< of a keypoint in a layer, to take part in the layer's alignment

/// Layer membership. The residual sigma sets how much evidence a residual is; kEvidence how much more a
/// residual weighs than the spatial prior; kMemory over how many pictures it is averaged.
constexpr double kResidualSigma = 8;       ///< grey levels
constexpr double kOutlierSigma = 16;       ///< grey levels; Geman-McClure: larger residuals lose their weight
constexpr double kEvidence = 3;            ///< factor
constexpr double kMemory = 20;             ///< pictures
constexpr float kPriorOutsideMap = 0.05F;  ///< kept by every layer once there is a map

/// Gauss-Newton steps per level, fine level first.
constexpr int kAlignmentSteps[] = {3, 2};
/// Prior of a body about the ground, and of the ground about rest: more lets noise move resting parts.
constexpr double kDisplacementSigma = 0.5;  ///< eye distances
constexpr double kScaleSigma = 0.02;        ///< of scale (ratio) and rotation (radians)

/// Hysteresis: a part at rest begins to move when that leaves less than kBeginMoving of the cost at rest; a
/// moving part stops at more than kStopMoving. The first must be the smaller.
constexpr double kBeginMoving = 0.8, kStopMoving = 0.92;
static_assert(kBeginMoving < kStopMoving);
constexpr double kMinGain = 2;        ///< squared grey levels per keypoint, to begin to move
constexpr double kRestartBody = 0.6;  ///< of the cost at rest; a body that leaves more starts elsewhere too
constexpr double kBodyPerHead = 0.5;  ///< of the head's displacement: where that alignment starts

/// A moving camera shows along the rim of the picture, at its sides and top, where hair in front of an even
/// wall, which moves too, does not reach. This many of the rim's ten pieces must each show this many
/// keypoints.
constexpr double kRimWidth = 0.17;       ///< of the picture
constexpr double kRimBottom = 0.75;      ///< of the picture: where the rim's sides end
constexpr float kMinGroundOnRim = 0.5F;  ///< prior of the ground
constexpr int kMinRimPieces = 4, kMinRimKeypoints = 3;

// --- The map (surround_fit) ---

constexpr double kCellsAlongLongSide = 22;  ///< detail of the map against its bytes and time
constexpr int kMapLongSide = 360;           ///< work pixels: precision against time and memory
constexpr int kSamplesAcrossCell = 5;       ///< each way
constexpr double kTruncation = 45;  ///< grey levels; larger differences are something that has come into view
constexpr double kMinCellArea = 0.05;  ///< of its area in the first picture; smaller ones count as folded
/// Weights of the labelling, in squared grey levels over a cell, per quarter of a share: for a change between
/// neighbours, and for a departure from the spatial prior.
constexpr double kSmoothness = 12, kPlacePrior = 4;
constexpr int kStartSweeps = 6, kSweeps = 3;  ///< of ICM at most
constexpr double kMaxLabelChange = 2;         ///< quarters in one step, unless a neighbour has the label

}  // namespace fbs::surround
