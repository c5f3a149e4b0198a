// Tuned constants of the fit. Set by eye and by face PSNR on the ten clips unless stated otherwise.
#pragma once

#include "common/generic_head.h"

namespace fbs {

// Sample points. Denser points steady the fit, but the time of a step grows with the square.
inline constexpr int kFitLevels = 2;             ///< of the luma pyramid: the work frame and half its size
inline constexpr double kFitPointSpacing = 2.5;  ///< work pixels between neighbours
inline constexpr int kMinMouthRows = 5;          ///< rows of points across a triangle of the mouth interior
inline constexpr double kMinSkinningShare =
    0.01;  ///< a control point that moves no corner by more is left out

// Residuals. The sigma scales the picture against the priors below; from kHuberLevels on, differences (teeth,
// shadows) pull with constant force.
inline constexpr double kResidualSigma = 6;  ///< grey levels
inline constexpr double kHuberLevels = 48;   ///< grey levels

// Priors: standard deviations about the start, which is the tracked pose, the contours and the light of the
// picture before. Smaller: less jitter, slower to follow.
inline constexpr double kPoseSigma = 0.006;  ///< rad, eye distances, log2; the tracker aligned this picture
inline constexpr double kOuterLipSigma = 0.012;  ///< eye distances; contours show lips and lids better than
inline constexpr double kInnerLipSigma = 0.005;  ///< textures do,
inline constexpr double kLidSigma = 0.007;
inline constexpr double kBrowSigma = 0.034;   ///< and textures show brows better than contours
inline constexpr double kOtherSigma = 0.034;  ///< eye distances; lower lids and pupils
inline constexpr double kLightSigma = 4;      ///< grey levels
inline constexpr double kInteriorSigma = 8;   ///< grey levels; of the mouth interior

// Priors: standard deviations about rest. Smaller: a fit that the picture leaves free returns sooner.
inline constexpr double kLightRestSigma = 40;     ///< grey levels; about no light of its own
inline constexpr double kInteriorRestSigma = 30;  ///< grey levels; about the setup's mouth colours
inline constexpr double kLidRestSigma = 0.12;     ///< eye distances; lips and brows: expression_prior.h
inline constexpr double kGazeRestSigma = 0.06;    ///< eye distances; of pupils
inline constexpr double kGazeSigma = 0.015;       ///< eye distances; of one pupil against the other

// Gauss-Newton.
inline constexpr int kStepsOfLevel[kFitLevels] = {3, 2};  ///< fine level first
/// When a single step changes a number of the light by more, picture and pattern had little in common at the
/// start. Grey levels; in 2169 pictures of ten clips one changes by more than 8, and none by more than 12.
inline constexpr double kMaxLightStep = 16;
inline constexpr double kMaxOffset = 0.35 * kUnitsPerEyeDistance;  ///< head units, of a control point
/// The same of lips: a shouting mouth opens by 0.8 eye distances.
inline constexpr double kMaxLipOffset = 0.7 * kUnitsPerEyeDistance;
/// The same of a pupil, to the side and up or down: eyeballs, a fifth of the eye distance in radius, turn by
/// less than 55 and 25 degrees. Beyond that the fit has mistaken lashes for the iris, and eyes are torn.
inline constexpr double kMaxGazeX = 0.16 * kUnitsPerEyeDistance, kMaxGazeY = 0.08 * kUnitsPerEyeDistance;
/// The same of an upper lid, upwards: its vertices rise by two thirds, 0.09 eye distances. In ten clips the
/// widest eyes open by 0.07 more than at rest. Beyond that the fit has mistaken the brow or shadows for
/// the lid.
inline constexpr double kMaxLidRise = 0.135 * kUnitsPerEyeDistance;
/// Inner lips farther than this from where the outer ones carry them are also tried from there. Eye
/// distances.
inline constexpr double kInnerLipsStray = 0.04;

/// FitStart of landmarks. They show how far a mouth is open better than textures do, which have little of its
/// inside: the openings of 36 strangers' mouths correlate with an independent tracker's by 0.88 in the
/// median, with 1 and 0.93 by 0.79. With 0.3 for the lips it is 0.03 more in the mean of ten of them, but the
/// small faces of claire and foreman lose 0.3 and 0.1 dB.
inline constexpr double kLandmarkLips = 0.5, kLandmarkCounts = 0.5;

// Lids.
/// Candidates of the search, in shares of the way from open to shut.
inline constexpr double kLidClosings[] = {-0.3, 0, 0.2, 0.4, 0.6, 0.8, 1};
/// Squared grey levels for lids whose closing differs by the whole way: larger keeps out winks, and the noise
/// of one eye.
inline constexpr double kLidsApartCost = 60;
/// How far a shut upper lid passes the lower one, so that nothing of the eye shows between them. Eye
/// distances.
inline constexpr double kLidOverlap = 0.01;

// Gaze.
/// Candidates of the search, to the side, in shares of kMaxGazeX.
inline constexpr double kGazes[] = {-1, -0.5, 0, 0.5, 1};
/// The gaze stays unless another reduces the difference below this share.
inline constexpr double kGazeKept = 0.8;

// Both searches.
inline constexpr double kSearchResidualSigma = 30;  ///< grey levels; larger differences hardly count more
inline constexpr float kMinMovedShare = 0.05F;      ///< share of control points in a sample point's motion
inline constexpr int kSearchLevel = 1;              ///< coarse: compares areas, not edges

}  // namespace fbs
